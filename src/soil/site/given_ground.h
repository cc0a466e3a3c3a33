#pragma once

#include <vector>

namespace tera {

/// Heights of undisturbed ground from another source than a scenario's `terrain:` mapping: a mesh
/// of the site.
///
/// Frames  W: a grid of square cells whose middle is W's origin.
/// Model   bilinear between its vertices; the site's size is that of the grid.
struct GivenGround {
  int nx = 0, ny = 0;
  double cell_m = 0;
  std::vector<double> height_m;  ///< row-major, x fastest and y northwards
};

}  // namespace tera
