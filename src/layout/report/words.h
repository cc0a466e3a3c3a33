#pragma once

#include <string>

#include "core/html.h"
#include "layout/layout_report.h"

namespace tera {

/// What a figure says, for people: "space around the machine seen by 1 sensor or more".
std::string Describe(const FigureId& id);
/// A value of it with its unit: "71 %", "4.2 m³".
std::string ValueText(const FigureId& id, double value);

/// A figure's mean, its worst moment and when that is: "50.0 % on average and 25.0 % at the worst
/// moment, at 3.2 s".
std::string MeanAndWorstText(const LayoutReport& report, const Figure& figure);
/// A name without the signs that stand for spaces.
std::string Spaced(std::string text);

/// What a rig takes, as far as it says so: "cost 4500 (2 of 3 sensors priced), ...".
std::string ExpenseText(const Expense& expense);

}  // namespace tera
