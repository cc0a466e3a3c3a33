#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "diagnose/perception/scans/range_source.h"

namespace tera {

/// A cell of the site by index.
using CellIndex = std::pair<int, int>;

/// The cell of side `cell_m` that contains a position; the lower corner of (i, j) is at cell_m (i,
/// j).
CellIndex CellAt(const Vec2& xy_W_m, double cell_m);

/// Height of one measured point over the simulated ground below it.
struct HeightDifference {
  std::size_t scan = 0, point = 0;
  CellIndex cell;
  double above_m = 0;
  CellIndex simulated;  ///< cell of the ray's simulated hit
};

/// Adds the height differences of one scan. Leaves out points on simulated objects, on their edges,
/// and on cliffs of the simulated ground, where a small pose error becomes a height difference.
///
/// Frames  W.
///
/// `scale`: sensor noise over its model. `excluded`: points with another explanation.
void AddHeightDifferences(const RangeSource& source, const SensorCalibration& calibration,
                          double scale, std::size_t scan, const std::vector<bool>& excluded,
                          double cell_m, std::vector<HeightDifference>* differences);

}  // namespace tera
