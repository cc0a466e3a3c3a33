#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "diagnose/perception/registration/registration_block.h"
#include "diagnose/perception/scans/range_source.h"

namespace tera {

/// Difference between measured and simulated ground height in one cell.
struct GroundCell {
  double above_m = 0;  ///< median over blocks of time of the median of points
  int region = -1;     ///< index of its region; -1: none
};

/// A region in which the measured ground height differs from the simulated one.
struct GroundRegion : SceneDifference {
  double area_m2 = 0;
  double volume_m3 = 0;  ///< measured minus simulated; negative for missing soil
  double mean_m = 0, lowest_m = 0, highest_m = 0;
  bool upright = false;  ///< higher than simulated and too steep for soil: an object
};

/// Ground cells by index. The lower corner of cell (i, j) is at cell_m * (i, j).
struct GroundMap {
  double cell_m = 0.25;
  std::map<std::pair<int, int>, GroundCell> cells;
  std::vector<GroundRegion> regions;
  std::vector<GroundRegion> unconfirmed;
  /// Points that a confirmed region explains.
  PointFlags explained;
};

/// Compares measured with simulated ground heights, cell by cell.
///
/// Frames  W.
/// Model   Each point gives a height difference to the simulated ground below it
///         (AddHeightDifferences). Cells are 0.25 m wide. A cell has one median per block of time,
///         and Student's t over these medians tests its difference. A prior of eight blocks with a
///         scatter of 2 cm moderates the variance. A standard error of 1 cm is added, which no
///         number of scans reduces.
///         Cells that differ by at least 5 cm on TRAIN and SELECT are selected at a false discovery
///         rate of 0.01 (Benjamini and Hochberg). The whole recording and its two halves are tested
///         separately. Four or more selected cells with the same sign form a region. Regions bridge
///         gaps of up to 0.5 m and include the unseen cells between.
///         A region is confirmed if FINAL shows at least half its height, at one per cent over the
///         regions.
/// Omits   Ground that no ray hits; ground that changes and changes back.
/// Source  Benjamini and Hochberg 1995; moderated t: Smyth 2004.
///
/// `scale`: actual sensor noise over modelled noise. `excluded`: points that another difference
/// explains.
GroundMap CompareGround(const RangeSource& source, const ScanSplit& split,
                        const SensorCalibration& calibration, double scale,
                        const PointFlags& excluded);

}  // namespace tera
