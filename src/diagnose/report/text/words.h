#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "diagnose/search/block/block_diagnosis.h"

/// Numbers and names for readers. Data are in radians; text and figures are in degrees.

namespace tera {

/// A value in SI units, multiplied by `factor`, has the unit `name`.
struct ReadableUnit {
  double factor = 1;
  std::string name;  ///< empty: dimensionless
};

ReadableUnit ReadableUnitOf(std::string_view unit);
/// Readable unit of a parameter. Angular frequencies stay in rad/s.
ReadableUnit ReadableUnitOf(const ParameterEstimate& parameter);

/// "3.1 deg/s"; "3.1" without a unit.
std::string WithUnit(const std::string& number, const ReadableUnit& unit);

/// A number with `digits` significant digits and no trailing zeros: 0.18, 52300, 1.2e-07.
std::string Significant(double value, int digits);
/// "3.1 deg/s" for a value in SI units, with two significant digits.
std::string Readable(double value, const ReadableUnit& unit);
std::string Readable(double value, std::string_view si_unit);
/// "3.1 → 0.6 deg/s" for values in SI units.
std::string Change(double before, double after, const ReadableUnit& unit);
std::string Change(double before, double after, std::string_view si_unit);
/// "0.18 ± 0.02". The deviation has one digit, or two if it begins with 1. The value has the same
/// decimal places. Without a deviation, the value has three digits.
std::string WithSigma(double value, const std::optional<double>& sigma);
/// "p 0.003", "p < 0.0001".
std::string ProbabilityText(double p);
/// "94 %": whole per cent.
std::string PercentText(double share);
/// A time without its unit. A span of `span_s` sets the number of decimals.
std::string TimeText(double time_s, double span_s);
/// "41–63 s and 8 more intervals".
std::string IntervalsText(double from_s, double to_s, std::size_t more);

/// "dead band" for "dead_band".
std::string Spaced(std::string_view identifier);
/// "delay" for "delay_s".
std::string WithoutUnit(std::string_view key);
/// "boom rate" for "excavator1/encoders/boom_radps".
std::string QuantityOf(const std::string& channel);
/// "lever" for "lever/boom" in the block of the boom; "arm lever" for "lever/arm".
std::string VariableText(const std::string& variable, const ReplayBlock& block);
/// SI unit of a variable. `channel_unit` is the unit of the block's channel.
std::string UnitOfVariable(const std::string& variable, const std::string& channel_unit);
std::string Capitalised(std::string text);
/// "a, b and c".
std::string Listed(const std::vector<std::string>& names);

/// A mechanism in plain words for users of a machine.
///
/// `meaning` is a sentence with placeholders in braces, which FilledIn (cause_text.h) fills:
/// {The}, {the}: the target; {width}: the parameter of that name with its unit; {0}: the first
/// parameter; {width%}: its magnitude in per cent; {gain~faster~slower}: its excess over 1 in per
/// cent, with the word for its sign; {exponent?slower?faster}: the word alone;
/// {offset_s:ahead:behind}: its magnitude with the word for its sign; {difference%:faster:slower}:
/// the same in per cent; {eta_radps#}: its frequency in Hz; {beta_1ps^}: the time in which a decay
/// falls to 1 / e; {numbers}: all reported parameters with their names; {axes}: the axes with a
/// parameter.
struct MechanismWords {
  /// As in Mechanism. For measured poses "poses/latency", which has its own sentence.
  std::string_view id;
  std::string_view label;    ///< two or three words that can follow "this"
  std::string_view meaning;  ///< one sentence
};

/// Words for a mechanism on a target; nullptr if there are none.
const MechanismWords* WordsOf(std::string_view id, std::string_view target = "");

}  // namespace tera
