#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "diagnose/perception/registration/registration_block.h"
#include "diagnose/perception/scans/range_source.h"

namespace tera {

/// Measured minus simulated ground height in one cell of the site.
struct GroundCell {
  double above_m = 0;  ///< median over blocks of time of the median of points
  int region = -1;     ///< index of its region; -1: none
};

/// A region in which the measured ground height differs from the simulated one.
struct GroundRegion : SceneDifference {
  double area_m2 = 0;
  double volume_m3 = 0;  ///< measured minus simulated: negative for missing soil
  double mean_m = 0, lowest_m = 0, highest_m = 0;
  bool upright = false;  ///< higher and too steep for soil: an object
};

/// Cells of the site by index; the lower corner of (i, j) is at cell_m * (i, j).
struct GroundMap {
  double cell_m = 0.25;
  std::map<std::pair<int, int>, GroundCell> cells;
  std::vector<GroundRegion> regions;
  std::vector<GroundRegion> unconfirmed;
  /// Points that a region explains.
  PointFlags explained;
};

/// Compares measured with simulated ground, cell by cell.
///
/// Frames  W.
/// Model   height of each point over the simulated ground below it. Points on simulated objects and
///         on their edges do not count (a ray turned by up to 1.2 deg would meet one). Each cell of
///         0.25 m has a median for each block of time, and Student's t of these over blocks. Eight
///         blocks that agree within 2 cm moderate their variance. Each median has an error of 1 cm
///         that no number of scans reduces. Benjamini and Hochberg's procedure selects cells of 5
///         cm or more on TRAIN and SELECT at a false discovery rate of 0.01. Four or more with one
///         sign form a region. Regions bridge gaps of up to half a
///         metre, and include the unseen cells between. A region stays if it has at least half its
///         height on FINAL, at one per cent over the regions. The two halves of the recording are
///         also examined separately.
/// Omits   ground without any ray; ground that moves and moves back.
/// Source  Benjamini and Hochberg 1995; moderated t: Smyth 2004.
///
/// `scale`: sensor noise over its model. `excluded`: points with another explanation.
GroundMap CompareGround(const RangeSource& source, const ScanSplit& split,
                        const SensorCalibration& calibration, double scale,
                        const PointFlags& excluded);

}  // namespace tera
