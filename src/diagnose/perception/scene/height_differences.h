#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "diagnose/perception/scans/range_source.h"

namespace tera {

/// A square of the site by index.
using CellIndex = std::pair<int, int>;

/// The square of side `cell_m` that a place lies in; the lower corner of (i, j) is at cell_m (i,
/// j).
CellIndex CellAt(const Vec2& xy_W_m, double cell_m);

/// Height of one measured point over the simulated ground below it.
struct HeightDifference {
  std::size_t scan = 0, point = 0;
  CellIndex cell;
  double above_m = 0;
  CellIndex simulated;  ///< cell of what the ray meets in the simulation
};

/// Adds those of one scan, but for points on simulated objects, on their edges, and on cliffs of
/// the simulated ground, which a small error of the pose turns into differences of height.
///
/// Frames  W.
///
/// `scale`: of the sensor's noise over its model. `excluded`: points that something else explains.
void AddHeightDifferences(const RangeSource& source, const SensorCalibration& calibration,
                          double scale, std::size_t scan, const std::vector<bool>& excluded,
                          double cell_m, std::vector<HeightDifference>* differences);

}  // namespace tera
