#pragma once

#include <algorithm>

namespace tera {

/// How far off a shovel the ground is looked at that it meets: past the cut itself, of which the
/// nearest column that stands is up to a cell away and shows, bilinear, over another half. A length
/// of its own, so that what is met does not depend on the cell unless cells are wider than 5 cm.
inline double LookBeside_m(double length_m, double cell_m) {
  constexpr double kPastTheCut_cells = 1.5;
  return std::max(length_m, kPastTheCut_cells * cell_m);
}

}  // namespace tera
