#pragma once

#include <optional>
#include <string>
#include <vector>

#include "layout/layout_report.h"

namespace tera {

/// Distances at which people are always detected, the hardest posture first.
std::vector<std::string> PeopleAnswer(const LayoutReport& report);

/// The postures for which the report has ranges of detection.
std::vector<std::string> PosturesOf(const LayoutReport& report);

/// Distances of detection at every moment and in every direction of a quarter.
struct AlwaysDetected {
  double from_m = 0, to_m = 0;  ///< nearest and farthest
  bool has_gaps = false;        ///< at some moment a distance in between has no detection

  bool IsNowhere() const { return from_m > to_m; }
};
/// Returns nothing if the report has no such figures.
std::optional<AlwaysDetected> AlwaysDetectedIn(const LayoutReport& report,
                                               const std::string& posture, std::size_t quarter);
/// "from 7 to 16 m", "at 7 m", "at no distance".
std::string RangeText(const AlwaysDetected& always);
/// Explains the quarters and the origin of the distances.
std::string QuartersText();

}  // namespace tera
