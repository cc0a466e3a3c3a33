#pragma once

#include <string>
#include <vector>

#include "campaign/sweep/effects.h"

namespace tera {

/// SVG plot with one panel per factor. It shows runs as points, and means of levels with confidence
/// intervals. Numeric levels are placed by value, with the least-squares line. Text levels are
/// placed side by side; if there are many, only every n-th has a label.
std::string SweepPlot(const std::vector<FactorEffect>& effects, const std::vector<SweptRun>& runs,
                      const std::string& figure);

}  // namespace tera
