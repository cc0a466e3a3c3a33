#pragma once

#include <optional>
#include <string>
#include <vector>

#include "layout/layout_report.h"

namespace tera {

/// Sentences with the distances at which people are detected at all times, the hardest posture
/// first.
std::vector<std::string> PeopleAnswer(const LayoutReport& report);

/// Names of the postures in the report's figures.
std::vector<std::string> PosturesOf(const LayoutReport& report);

/// The distances at which a person is detected at every moment and in every direction of a quarter.
struct AlwaysDetected {
  double from_m = 0, to_m = 0;  ///< nearest and farthest; from_m > to_m if there are none
  bool has_gaps = false;        ///< at some moment a distance in between has no detection

  bool IsNowhere() const { return from_m > to_m; }
};
/// Returns nothing if the report lacks these figures.
std::optional<AlwaysDetected> AlwaysDetectedIn(const LayoutReport& report,
                                               const std::string& posture, std::size_t quarter);
/// "from 7 to 16 m", "at 7 m", "at no distance".
std::string RangeText(const AlwaysDetected& always);
/// A sentence that defines the quarters and the zero of the distances.
std::string QuartersText();

}  // namespace tera
