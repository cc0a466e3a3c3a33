#pragma once

#include <algorithm>

namespace tera {

/// Distance from a shovel at which the ground that it meets is read. It lies past the cut itself:
/// the nearest standing column is up to a cell away, and shows, bilinear, over another half. It has
/// a length of its own, so that the result depends on the cell only for cells wider than 5 cm.
inline double ContactProbeDistance_m(double length_m, double cell_m) {
  constexpr double kPastTheCut_cells = 1.5;
  return std::max(length_m, kPastTheCut_cells * cell_m);
}

}  // namespace tera
