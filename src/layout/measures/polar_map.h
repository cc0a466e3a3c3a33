#pragma once

#include <string>
#include <vector>

#include "layout/measures/figure_id.h"

namespace tera {

/// A number for each cell of a polar grid around a point, to be drawn.
///
/// Frames  azimuth 0 is ahead, counterclockwise from above; cell (sector, ring) is at
///         sector * rings + ring.
struct PolarMap {
  FigureId id;
  std::string title;  ///< for people
  int sectors = 0, rings = 0;
  double ring_m = 1;  ///< width of a ring, in `ring_unit`
  std::string ring_unit = "m";
  double low = 0, high = 1;   ///< at the bad and the good end of the colours
  std::vector<double> value;  ///< negative where there is none
  /// Values that lie at even steps of the colours, from `low` to `high`; empty: those between are
  /// spread evenly. Where they are given, what is at `low` is nothing, and has a colour of its own.
  std::vector<double> ticks = {};
};

/// Whether a map's middle is the machine's, so that its outline may be drawn on it.
inline bool IsAboutMachine(const PolarMap& map) {
  return map.id.measure == Measure::kSeenMap || map.id.measure == Measure::kPixelMap;
}

/// A distance for each direction around a point, to be drawn.
///
/// Frames  as PolarMap.
struct PolarCurve {
  FigureId id;
  std::string title;                ///< for people
  double most = 1;                  ///< of the axis
  std::vector<double> mean, worst;  ///< over a cycle, of each direction
  /// Where what holds at the worst moment begins, of each direction; empty: at the point.
  std::vector<double> worst_from = {};
};

}  // namespace tera
