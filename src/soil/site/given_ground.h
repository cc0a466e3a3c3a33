#pragma once

#include <vector>

namespace tera {

/// Heights of undisturbed ground that do not come from the scenario's `terrain:` mapping, but from
/// a mesh of the site.
///
/// Frames  W: a grid of square cells with its middle at the origin of W.
/// Model   Bilinear between vertices. The site has the size of the grid.
struct GivenGround {
  int nx = 0, ny = 0;
  double cell_m = 0;
  std::vector<double> height_m;  ///< row-major, x fastest and y northwards
};

}  // namespace tera
