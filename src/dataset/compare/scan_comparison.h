#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "dataset/compare/frame_pairs.h"

namespace tera {

/// Limits of the bins in which ranges are counted; the last bin has no upper limit.
inline constexpr std::array<double, 10> kRangeLimits_m = {0, 1, 2, 5, 10, 20, 35, 50, 75, 100};
/// Shares at which reflectivity is reported.
inline constexpr std::array<double, 5> kReflectivityShares = {0.05, 0.25, 0.5, 0.75, 0.95};

/// Points of a lidar in one recording.
struct ScanSide {
  std::int64_t points = 0;
  std::int64_t second_returns = 0;       ///< points behind the first return of their ray
  std::optional<double> without_return;  ///< share of rays; none if sensor.yaml has no columns
  /// Robust deviation of ranges on planes in each bin of kRangeLimits_m (DeviationsOnPlanes); none
  /// where fewer than 30 points were judged.
  std::array<std::optional<double>, kRangeLimits_m.size()> plane_deviation_m{};
  std::array<double, kRangeLimits_m.size()> range_share{};
  std::array<double, kReflectivityShares.size()> reflectivity{};  ///< quantiles
};

/// Rays of one labelled class, and those of them without a return in the other recording.
struct ClassDropOut {
  std::string name;
  bool is_of_b = true;  ///< which recording has the labels
  std::int64_t rays = 0, lost = 0;
};

struct DistanceFigures {
  std::int64_t count = 0;
  double mean_m = 0, median_m = 0, most_m = 0;  ///< `most`: 95 % are nearer
};

/// A lidar in two recordings: `a` is the reference.
struct ScanComparison {
  SensorInBoth sensor;
  ScanSide a, b;
  /// Rays that return in both, only in a, only in b (PairRays).
  std::int64_t rays_both = 0, rays_only_a = 0, rays_only_b = 0;
  std::vector<ClassDropOut> classes;
  /// Range of b less that of a, over rays that return in both.
  double range_mean_m = 0, range_median_m = 0, range_rms_m = 0;
  double reflectivity_ratio = 0;   ///< median of b over a, on rays that both see and a sees bright
  DistanceFigures a_to_b, b_to_a;  ///< to the nearest point
  DistanceFigures a_to_surface, b_to_surface;  ///< to the other's surface
  double chamfer_m = 0;  ///< mean over frames of both mean distances to the nearest point, added
  std::vector<WorstFrame> worst;  ///< by that distance
};

/// Compares the scans of lidars that both machines have, in the sensor's frame, so that a place or
/// attitude that differs shows as well. DistancesFrom and PairRays have the model.
std::vector<ScanComparison> CompareScans(const RecordedMachine& a, const RecordedMachine& b,
                                         std::size_t every);

std::string ScanTable(const ScanComparison& comparison);

}  // namespace tera
