#pragma once

#include <string>

#include "core/html.h"
#include "layout/layout_report.h"

namespace tera {

/// Description of a figure: "space around the machine seen by 1 sensor or more".
std::string Describe(const FigureId& id);
/// A figure's value with its unit: "71 %", "4.2 m³".
std::string ValueText(const FigureId& id, double value);

/// Mean, worst value and its time: "50.0 % on average and 25.0 % at the worst moment, at 3.2 s".
std::string MeanAndWorstText(const LayoutReport& report, const Figure& figure);
/// Replaces the word separators of a name by spaces.
std::string Spaced(std::string text);

/// Cost, power and data of a rig as far as given: "cost 4500 (2 of 3 sensors priced), ...".
std::string ExpenseText(const Expense& expense);

}  // namespace tera
