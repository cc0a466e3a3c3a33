#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "diagnose/perception/scans/range_source.h"

namespace tera {

/// Finds the points of a scan at which a simulated object begins to occlude its background. A ray
/// turned by 0.4 or 1.2 deg, in eight directions, meets an object within 0.3 m of the measured
/// range, or one of unknown shape. Poses and encoders are too inexact for comparing such points.
std::vector<bool> OnOcclusionEdges(const RangeSource& source, const SensorCalibration& calibration,
                                   std::size_t scan, const std::vector<std::size_t>& points);

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
