#pragma once

#include <string>
#include <vector>

#include "campaign/sweep/effects.h"

namespace tera {

/// SVG with a panel for each factor: runs as points, means of levels with their intervals. Numbers
/// stand at their place, with the line of least squares; texts side by side, many with a label at
/// each second, third and so on.
std::string SweepPlot(const std::vector<FactorEffect>& effects, const std::vector<SweptRun>& runs,
                      const std::string& figure);

}  // namespace tera
