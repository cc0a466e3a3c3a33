#pragma once

#include <utility>
#include <vector>

#include "diagnose/perception/registration/scan_split.h"
#include "diagnose/perception/scans/range_source.h"

namespace tera {

/// Dust in the air, which reflects some rays before they reach a surface and lets others pass.
struct DustCloud {
  Vec3 centre_W_m = Vec3::Zero(), low_W_m = Vec3::Zero(), high_W_m = Vec3::Zero();
  std::size_t returns = 0;  ///< from within
  double thickness_m = 0;   ///< of the returns within a cubic metre, in their thinnest direction
  double stopped = 0;       ///< share of the rays that came to it while it was there
  double p_chosen = 1, p_confirmed = 1;
  std::vector<std::pair<double, double>> intervals_s;  ///< when; empty: all the time
};

/// Clouds of returns from the air.
///
/// Frames  W.
/// Model   returns 0.5 m and more before what their ray meets in the simulation, 0.3 m and more
///         over the simulated ground, and not on the edge of an object. Voxels of half a metre that
///         hold some, linked over one voxel's gap, make a cloud of 40 returns and more. A cloud is
///         dust where of the rays that came to its voxels fewer than 60 % ended there, and where
///         the returns within a cubic metre scatter by 0.1 m and more in every direction (half of
///         the returns do). Student's t over blocks of time, their variance moderated by eight
///         blocks that agree within a tenth, must say that more than one ray in 200 ended there:
///         on TRAIN and SELECT at five per cent over the clouds, in the whole recording, a half, a
///         quarter or an eighth of it; on FINAL at one per cent, of whose blocks those count that
///         lie from the first to the last in which the others show the cloud. What stops more is a
///         solid object.
/// Omits   rays that the dust swallowed, of which a scan holds no point. A tree or a fence that the
///         scenario has not passes for dust: it stops some rays at many depths too.
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
