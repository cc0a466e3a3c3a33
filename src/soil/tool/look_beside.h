#pragma once

#include <algorithm>

namespace tera {

/// Distance from a shovel at which the surrounding ground is sampled. The sample must lie beyond
/// the cut: one cell to the nearest standing column, plus half a cell of bilinear interpolation. A
/// fixed least length makes the result independent of cells up to 5 cm.
inline double LookBeside_m(double length_m, double cell_m) {
  constexpr double kPastTheCut_cells = 1.5;
  return std::max(length_m, kPastTheCut_cells * cell_m);
}

}  // namespace tera
