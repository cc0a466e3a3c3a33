#pragma once

#include <vector>

#include "diagnose/perception/registration/registration_block.h"
#include "diagnose/perception/scans/range_source.h"

namespace tera {

/// A dust cloud: it reflects some rays before they reach a surface and lets others pass.
struct DustCloud : SceneDifference {
  double top_m = 0;         ///< height of the highest return, in W
  std::size_t returns = 0;  ///< number of returns from the cloud
  double thickness_m = 0;   ///< median over the cloud's returns of the standard deviation within 1
                            ///< m^3, in its thinnest direction
  double stopped = 0;       ///< share of rays that end in the cloud, among those that reach it
};

/// Finds dust clouds.
///
/// Frames  W.
/// Model   An air return lies at least 0.5 m in front of the simulated hit of its ray. An air
///         return also lies at least 0.3 m above the simulated ground. Returns at edges of
///         simulated objects are left out. Voxels of 0.5 m with air returns are linked across gaps
///         of one voxel. A cloud has at least 40 returns.
///         A cloud is dust if at most 60 % of the rays that reach it end in it; otherwise it is a
///         solid object. In addition, the returns of dust must scatter by at least 0.1 m in every
///         direction (median over cubic metres).
///         The test asks if more than one ray in 200 ends in the cloud, by Student's t over blocks
///         of time. A prior of eight blocks with a scatter of a tenth moderates the variance. TRAIN
///         and SELECT are tested over the whole recording, its halves, quarters and eighths. The
///         level on TRAIN and SELECT is five per cent over the clouds, on FINAL one per cent. FINAL
///         is limited to the time between the first and last block in which TRAIN and SELECT show
///         the cloud.
/// Omits   Rays that the dust absorbs, because scans contain no points for them. A tree or fence
///         missing in the scenario counts as dust, because it also stops some rays at many depths.
/// Source  Phillips et al. 2017, "When the dust settles: the four behaviors of lidar in the
///         presence of fine airborne particulates"; moderated t: Smyth 2004.
struct Dust {
  std::vector<DustCloud> clouds;
  std::vector<DustCloud> unconfirmed;
  PointFlags explained;  ///< returns from the clouds in both lists
};

Dust FindDust(const RangeSource& source, const ScanSplit& split,
              const SensorCalibration& calibration);

}  // namespace tera
