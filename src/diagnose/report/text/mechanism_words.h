#pragma once

#include <string_view>

namespace tera {

/// What a mechanism is in the words of someone who uses the machine.
///
/// `meaning` is a sentence with places in braces, which FilledIn (plain_sentence.h) fills:
/// {The}, {the}: what it acts on; {width}: the number of that name with its unit; {0}: the first
/// number; {width%}: its size in per cent; {gain~faster~slower}: by how much it is above or below
/// 1, in per cent, with the word for it; {exponent?slower?faster}: the word alone; {offset_s:ahead:
/// behind}: its size with the word for its sign; {difference%:faster:slower}: likewise in per cent;
/// {eta_radps#}: its frequency in Hz; {beta_1ps^}: the time over which what decays at it falls to
/// 1 / e; {numbers}: all reported numbers with their names; {axes}: the axes whose number is set.
struct MechanismWords {
  /// As of Mechanism; of measured poses "poses/latency", where another sentence holds for them.
  std::string_view id;
  std::string_view label;    ///< two or three words, which can follow "this"
  std::string_view kind;     ///< what it would be, without numbers
  std::string_view meaning;  ///< one sentence
};

/// The words for a mechanism on a target; nullptr where it has none.
const MechanismWords* WordsOf(std::string_view id, std::string_view target = "");

}  // namespace tera
