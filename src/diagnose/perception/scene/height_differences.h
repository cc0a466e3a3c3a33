#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "diagnose/perception/scans/range_source.h"

namespace tera {

/// Flags points at which a simulated object may begin to occlude its background. Test rays are
/// tilted from the measured ray by 0.4 and 1.2 deg, in eight directions. A point is flagged if a
/// test ray hits an object within 0.3 m of the measured range, or a body of unknown shape. Poses
/// and encoders are too inexact to compare such points.
std::vector<bool> OnOcclusionEdges(const RangeSource& source, const SensorCalibration& calibration,
                                   std::size_t scan, const std::vector<std::size_t>& points);

using CellIndex = std::pair<int, int>;

/// The cell with side `cell_m` that contains a position. The lower corner of cell (i, j) is at
/// cell_m * (i, j).
CellIndex CellAt(const Vec2& xy_W_m, double cell_m);

/// Height of one measured point above the simulated ground below it.
struct HeightDifference {
  std::size_t scan = 0, point = 0;
  CellIndex cell;
  double above_m = 0;
  CellIndex simulated;  ///< cell of the simulated hit of its ray
};

/// Appends the height differences of one scan, without points on simulated objects and at their
/// edges. Points at cliffs of the simulated ground are left out too, because a small pose error
/// causes a large height difference there.
///
/// Frames  W.
///
/// `scale`: actual sensor noise over modelled noise. `excluded`: points that another difference
/// explains.
void AddHeightDifferences(const RangeSource& source, const SensorCalibration& calibration,
                          double scale, std::size_t scan, const std::vector<bool>& excluded,
                          double cell_m, std::vector<HeightDifference>* differences);

}  // namespace tera
