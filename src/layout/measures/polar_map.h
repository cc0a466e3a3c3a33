#pragma once

#include <string>
#include <vector>

namespace tera {

/// A number for each cell of a polar grid around a point, to be drawn.
///
/// Frames  azimuth 0 is ahead, counterclockwise from above; cell (sector, ring) is at
///         sector * rings + ring.
struct PolarMap {
  std::string name;   ///< "seen/0.9 m"
  std::string title;  ///< for people
  int sectors = 0, rings = 0;
  double ring_m = 1;  ///< width of a ring
  double low = 0, high = 1;
  std::vector<double> value;  ///< negative where there is none
};

}  // namespace tera
