#pragma once

#include <vector>

#include "diagnose/perception/registration/registration_block.h"
#include "diagnose/perception/scans/range_source.h"

namespace tera {

/// Dust in the air, which reflects some rays ahead of a surface and lets others pass.
struct DustCloud : SceneDifference {
  double top_m = 0;         ///< its highest return, in W
  std::size_t returns = 0;  ///< returns from inside the cloud
  double thickness_m = 0;   ///< median thickness over cubic metres, each in its thinnest direction
  double stopped = 0;       ///< share of the rays that the cloud stopped, of those that reached it
};

/// Clouds of returns from the air.
///
/// Frames  W.
/// Model   returns at least 0.5 m in front of the simulated hit of their ray, at least 0.3 m above
///         the simulated ground, and not at an object's edge. Voxels of half a metre with such
///         returns, linked across gaps of one voxel, form a cloud if it has 40 returns or more. A
///         cloud is dust if fewer than 60 % of the rays that reached its voxels ended there. Half
///         of its returns must also scatter by 0.1 m or more in every direction, within their cubic
///         metre.
///         Significance: more than one ray in 200 ended there, by Student's t over blocks of time.
///         Eight blocks that agree within a tenth moderate its variance. On TRAIN and SELECT the
///         level is five per cent over the clouds, in the whole recording, a half, a quarter or an
///         eighth of it. On FINAL it is one per cent. FINAL's blocks lie between the first and the
///         last in which the other parts show the cloud. A cloud that stops more rays is a solid
///         object.
/// Omits   rays that the dust absorbed, since a scan has no point of them. A tree or fence missing
///         in the scenario counts as dust: it also stops some rays at many depths.
/// Source  Phillips et al. 2017, "When the dust settles: the four behaviors of lidar in the
///         presence of fine airborne particulates"; moderated t: Smyth 2004.
struct Dust {
  std::vector<DustCloud> clouds;
  std::vector<DustCloud> unconfirmed;
  PointFlags explained;  ///< returns from the clouds of both lists
};

Dust FindDust(const RangeSource& source, const ScanSplit& split,
              const SensorCalibration& calibration);

}  // namespace tera
