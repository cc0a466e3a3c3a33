#pragma once

#include <string>
#include <vector>

#include "layout/layout_report.h"

namespace tera {

/// What a figure says, for people: "space around the machine seen by 1 sensor or more".
std::string Describe(const Figure& figure);
/// A value of it with its unit: "71 %", "4.2 m^3".
std::string ValueText(const Figure& figure, double value);

/// The answer first: what the layout sees, what it does not and why, people, the bucket.
std::vector<std::string> Answer(const LayoutReport& report);

/// Characters that HTML reserves as entities.
std::string Escape(const std::string& text);

}  // namespace tera
