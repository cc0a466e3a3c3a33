#pragma once

#include <gmock/gmock.h>

#include <cctype>
#include <ostream>
#include <sstream>
#include <string>
#include <vector>

#include "core/error.h"

/// Tests of bad input check the kind and place of each fault, never its sentence.

namespace tera {

using FaultsMatcher = ::testing::Matcher<const std::vector<InputFault>&>;

/// The faults that `read` throws, or nothing.
template <typename Read>
std::vector<InputFault> FaultsIn(const Read& read) {
  try {
    read();
  } catch (const InputError& error) {
    return error.faults();
  }
  return {};
}

/// Whether `end` is the last part of `place`, in whole components. For "run/a.csv:3: k[0].x", that
/// may be "x", "k[0].x" or "a.csv:3: k[0].x". A trailing line, column or index may be left out.
inline bool EndsIn(std::string place, const std::string& end) {
  while (!place.ends_with(end)) {
    const bool is_item = place.ends_with(']');
    const std::size_t number = place.find_last_of(is_item ? "[" : ":");
    const std::size_t digits = is_item ? place.size() - 1 : place.size();
    if (number == place.npos || number + 1 == digits ||
        place.find_first_not_of("0123456789", number + 1) < digits) {
      return false;
    }
    place.resize(number);
  }
  const std::string before = place.substr(0, place.size() - end.size());
  return before.empty() || end.empty() ||
         std::string(" ./:[").find(before.back()) != std::string::npos;
}

/// Whether the place, or an enclosing place, ends in `end`. "site.yaml:1:10: geotiff" encloses a
/// place in the file that its key names.
inline bool LiesAt(const std::string& place, const std::string& end) {
  for (std::size_t at = place.find(": "); at != place.npos; at = place.find(": ", at + 1)) {
    if (EndsIn(place.substr(0, at), end)) return true;
  }
  return EndsIn(place, end);
}

MATCHER_P2(IsFault, kind, place, "") { return arg.kind == kind && LiesAt(arg.place, place); }

/// One of the faults is of that kind, at a place that ends in `place`.
inline auto HasFault(FaultKind kind, const std::string& place = "") {
  return ::testing::Contains(IsFault(kind, place));
}

/// One of the faults, of any kind, is at a place that ends in `place`.
inline auto HasFaultAt(const std::string& place) {
  return ::testing::Contains(::testing::Field(
      "place", &InputFault::place,
      ::testing::Truly([place](const std::string& at) { return LiesAt(at, place); })));
}

/// Matches exactly one fault, of that kind, at a place that ends in `place`.
inline auto HasOnlyFault(FaultKind kind, const std::string& place = "") {
  return ::testing::ElementsAre(IsFault(kind, place));
}

inline auto ThrowsFault(FaultKind kind, const std::string& place = "") {
  return ::testing::Throws<InputError>(
      ::testing::Property("faults", &InputError::faults, HasFault(kind, place)));
}

/// A printed line is "place: finding", and its place ends in `place`.
MATCHER_P(TellsOf, place, "") {
  std::istringstream lines(arg);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t end = line.rfind(": ");
    if (end != line.npos && LiesAt(line.substr(0, end), place)) return true;
  }
  return false;
}

inline void PrintTo(FaultKind kind, std::ostream* out) {
  constexpr const char* kNames[] = {"kMissing",    "kUnknown",    "kNoSuchName",   "kRepeated",
                                    "kMistyped",   "kOutOfRange", "kInconsistent", "kMalformed",
                                    "kUnreadable", "kUnwritable", "kUnsupported"};
  *out << kNames[static_cast<int>(kind)];
}

inline void PrintTo(const InputFault& fault, std::ostream* out) {
  PrintTo(fault.kind, out);
  *out << " at '" << fault.place << "': " << fault.finding;
}

}  // namespace tera
