#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "diagnose/search/block/block_diagnosis.h"

/// Numbers and names as people read them. Data are in radians; text and figures are in degrees.

namespace tera {

/// A value in SI units times `factor` is in `name`.
struct ReadableUnit {
  double factor = 1;
  std::string name;  ///< empty for a plain number
};

ReadableUnit ReadableUnitOf(std::string_view unit);
/// The readable unit of a parameter, for which angular frequencies stay in rad/s.
ReadableUnit ReadableUnitOf(const ParameterEstimate& parameter);

/// "3.1 deg/s", and without a unit "3.1".
std::string WithUnit(const std::string& number, const ReadableUnit& unit);

/// A number with `digits` significant digits and no trailing zeros: 0.18, 52300, 1.2e-07.
std::string Significant(double value, int digits);
/// "3.1 deg/s" of a value in SI units, with two significant digits.
std::string Readable(double value, const ReadableUnit& unit);
std::string Readable(double value, std::string_view si_unit);
/// "3.1 → 0.6 deg/s" of values in SI units.
std::string Change(double before, double after, const ReadableUnit& unit);
std::string Change(double before, double after, std::string_view si_unit);
/// "0.18 ± 0.02": the deviation with one digit, or two if it begins with 1; the value to the same
/// decimal place. Without a deviation three digits.
std::string WithSigma(double value, const std::optional<double>& sigma);
/// "p 0.003", "p < 0.0001".
std::string ProbabilityText(double p);
/// Whole percents: "94 %".
std::string PercentText(double share);
/// A time at a precision that suits a span of `span_s`, without its unit.
std::string TimeText(double time_s, double span_s);
/// "41–63 s and 8 more intervals".
std::string IntervalsText(double from_s, double to_s, std::size_t more);

/// "dead band" of "dead_band".
std::string Spaced(std::string_view identifier);
/// "delay" of "delay_s".
std::string WithoutUnit(std::string_view key);
/// "boom rate" of "excavator1/encoders/boom_radps".
std::string QuantityOf(const std::string& channel);
/// "lever" of "lever/boom" in the block of the boom, "arm lever" of "lever/arm".
std::string VariableText(const std::string& variable, const ReplayBlock& block);
/// SI unit of a variable of a channel in `channel_unit`.
std::string UnitOfVariable(const std::string& variable, const std::string& channel_unit);
std::string Capitalised(std::string text);
/// "a, b and c".
std::string Listed(const std::vector<std::string>& names);

/// A mechanism in the words of a machine's user.
///
/// `meaning` is a sentence with placeholders in braces, which FilledIn (cause_text.h) fills:
/// {The}, {the}: the target; {width}: the parameter of that name with its unit; {0}: the first
/// parameter; {width%}: its magnitude in per cent; {gain~faster~slower}: its excess over 1 in per
/// cent, with the word for its sign; {exponent?slower?faster}: the word alone; {offset_s:ahead:
/// behind}: its magnitude with the word for its sign; {difference%:faster:slower}: likewise in per
/// cent; {eta_radps#}: its frequency in Hz; {beta_1ps^}: the time in which a decay falls to 1 / e;
/// {numbers}: all reported parameters with their names; {axes}: the axes with a parameter.
struct MechanismWords {
  /// as in Mechanism; for measured poses "poses/latency", with a sentence of its own
  std::string_view id;
  std::string_view label;    ///< two or three words, which can follow "this"
  std::string_view meaning;  ///< one sentence
};

/// The words for a mechanism on a target; nullptr where it has none.
const MechanismWords* WordsOf(std::string_view id, std::string_view target = "");

}  // namespace tera
