#pragma once

#include <string>
#include <vector>

#include "layout/measures/figure_id.h"

namespace tera {

/// A value for each cell of a polar grid, for a drawing.
///
/// Frames  azimuth 0 is ahead and increases counterclockwise, seen from above. Cell (sector, ring)
///         has the index sector * rings + ring.
struct PolarMap {
  FigureId id;
  std::string title;  ///< caption of the drawing
  int sectors = 0, rings = 0;
  double ring_m = 1;  ///< width of a ring, in `ring_unit`
  std::string ring_unit = "m";
  double low = 0, high = 1;   ///< values at the bad and the good end of the colour scale
  std::vector<double> value;  ///< negative: no value
  /// Values at equal steps of the colour scale, from `low` to `high`. Empty: the scale is linear.
  /// With ticks, the value `low` means "nothing" and has its own colour.
  std::vector<double> ticks = {};
};

/// Whether the map is centred on the machine. The machine's outline can then be drawn on it.
inline bool IsAboutMachine(const PolarMap& map) {
  return map.id.measure == Measure::kSeenMap || map.id.measure == Measure::kPixelMap;
}

/// A distance for each direction around a point, for a drawing.
///
/// Frames  as PolarMap.
struct PolarCurve {
  FigureId id;
  std::string title;                ///< caption of the drawing
  double most = 1;                  ///< end of the axis
  std::vector<double> mean, worst;  ///< over a cycle, one per direction
  /// Near end of the range at the worst moment, one per direction. Empty: the range begins at the
  /// centre.
  std::vector<double> worst_from = {};
};

}  // namespace tera
