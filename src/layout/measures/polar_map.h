#pragma once

#include <string>
#include <vector>

#include "layout/measures/figure_id.h"

namespace tera {

/// A value for each cell of a polar grid around a point, for a drawing.
///
/// Frames  azimuth 0 is ahead, counterclockwise from above; cell (sector, ring) is at sector *
///         rings + ring.
struct PolarMap {
  FigureId id;
  std::string title;  ///< for people
  int sectors = 0, rings = 0;
  double ring_m = 1;  ///< width of a ring, in `ring_unit`
  std::string ring_unit = "m";
  double low = 0, high = 1;   ///< values at the bad and the good end of the colours
  std::vector<double> value;  ///< negative if there is none
  /// Values at equal steps of the colours, from `low` to `high`; empty: a linear scale. If they are
  /// given, the value `low` means nothing and has its own colour.
  std::vector<double> ticks = {};
};

/// Whether the map is centred on the machine, so that its outline can be drawn on it.
inline bool IsAboutMachine(const PolarMap& map) {
  return map.id.measure == Measure::kSeenMap || map.id.measure == Measure::kPixelMap;
}

/// A distance for each direction around a point, for a drawing.
///
/// Frames  as PolarMap.
struct PolarCurve {
  FigureId id;
  std::string title;                ///< for people
  double most = 1;                  ///< largest value of the axis
  std::vector<double> mean, worst;  ///< over a cycle, one per direction
  /// Near end of the range at the worst moment, one per direction; empty: the point itself.
  std::vector<double> worst_from = {};
};

}  // namespace tera
