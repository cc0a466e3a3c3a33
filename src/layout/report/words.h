#pragma once

#include <optional>
#include <string>
#include <vector>

#include "layout/layout_report.h"

namespace tera {

/// What a figure says, for people: "space around the machine seen by 1 sensor or more".
std::string Describe(const Figure& figure);
/// A value of it with its unit: "71 %", "4.2 m^3".
std::string ValueText(const Figure& figure, double value);

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
                                               const std::string& posture,
                                               const std::string& quarter);
/// "from 7 to 16 m", "at no distance".
std::string RangeText(const AlwaysDetected& always);
/// What quarters are, and from where distances are measured.
std::string QuartersText();

/// What a rig takes, as far as it says so: "cost 4500 (2 of 3 sensors priced), ...".
std::string ExpenseText(const Expense& expense);

/// The answer first: what the layout sees, what it does not and why, people, the bucket.
std::vector<std::string> Answer(const LayoutReport& report);

/// Characters that HTML reserves as entities.
std::string Escape(const std::string& text);

}  // namespace tera
