#pragma once

#include <string>

#include "core/html.h"
#include "layout/layout_report.h"

namespace tera {

/// A figure's description for people: "space around the machine seen by 1 sensor or more".
std::string Describe(const FigureId& id);
/// A value with its unit: "71 %", "4.2 m³".
std::string ValueText(const FigureId& id, double value);

/// A figure's mean, worst value and its time: "50.0 % on average and 25.0 % at the worst moment, at
/// 3.2 s".
std::string MeanAndWorstText(const LayoutReport& report, const Figure& figure);
/// A name with spaces instead of the signs that replace them.
std::string Spaced(std::string text);

/// Cost, power and data of a rig, if it states them: "cost 4500 (2 of 3 sensors priced), ...".
std::string ExpenseText(const Expense& expense);

}  // namespace tera
