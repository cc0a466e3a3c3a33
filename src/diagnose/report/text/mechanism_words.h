#pragma once

#include <string_view>

namespace tera {

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
