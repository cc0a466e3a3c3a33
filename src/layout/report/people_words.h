#pragma once

#include <optional>
#include <string>
#include <vector>

#include "layout/layout_report.h"

namespace tera {

/// From where to where people are always detected, the posture first that is hardest to detect.
std::vector<std::string> PeopleAnswer(const LayoutReport& report);

/// The postures of which the report says where they are detected.
std::vector<std::string> PosturesOf(const LayoutReport& report);

/// Where a person is detected at every moment and in every direction of a quarter.
struct AlwaysDetected {
  double from_m = 0, to_m = 0;  ///< nearest and farthest
  bool has_gaps = false;        ///< at some moment she is not at a distance in between

  bool IsNowhere() const { return from_m > to_m; }
};
/// Nothing where the report has no such figures.
std::optional<AlwaysDetected> AlwaysDetectedIn(const LayoutReport& report,
                                               const std::string& posture, std::size_t quarter);
/// "from 7 to 16 m", "at 7 m", "at no distance".
std::string RangeText(const AlwaysDetected& always);
/// What quarters are, and from where distances are measured.
std::string QuartersText();

}  // namespace tera
