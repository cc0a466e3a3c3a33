#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "dataset/compare/frame_pairs.h"

namespace tera {

/// Lower limits of the range bins. The last bin has no upper limit.
inline constexpr std::array<double, 10> kRangeLimits_m = {0, 1, 2, 5, 10, 20, 35, 50, 75, 100};
/// Quantiles at which reflectivity is reported.
inline constexpr std::array<double, 5> kReflectivityShares = {0.05, 0.25, 0.5, 0.75, 0.95};

/// Statistics of a lidar's points in one recording.
struct ScanSide {
  std::int64_t points = 0;
  std::int64_t second_returns = 0;  ///< number of points that are not the first return of their ray
  std::optional<double> without_return;  ///< fraction of rays without a return; absent if
                                         ///< sensor.yaml does not give the number of rays
  /// Robust standard deviation of ranges on planar surfaces, per bin of kRangeLimits_m
  /// (DeviationsOnPlanes). Absent for bins with fewer than 30 points.
  std::array<std::optional<double>, kRangeLimits_m.size()> plane_deviation_m{};
  std::array<double, kRangeLimits_m.size()> range_share{};
  /// at the quantiles kReflectivityShares
  std::array<double, kReflectivityShares.size()> reflectivity{};
};

/// Rays of one class, and how many of them have no return in the other recording.
struct ClassDropOut {
  std::string name;
  bool is_of_b = true;  ///< the labels are those of recording b
  std::int64_t rays = 0, lost = 0;
};

struct DistanceFigures {
  std::int64_t count = 0;
  double mean_m = 0, median_m = 0, most_m = 0;  ///< most_m is the 95 % quantile
};

/// Comparison of a lidar in two recordings. `a` is the reference.
struct ScanComparison {
  SensorInBoth sensor;
  ScanSide a, b;
  /// Number of rays with a return in both, only in a, and only in b (PairRays).
  std::int64_t rays_both = 0, rays_only_a = 0, rays_only_b = 0;
  std::vector<ClassDropOut> classes;
  /// Range in b minus range in a, over rays with a return in both.
  double range_mean_m = 0, range_median_m = 0, range_rms_m = 0;
  double reflectivity_ratio = 0;   ///< median of b / a, over rays with a return in both and a
                                   ///< reflectivity above the threshold in a
  DistanceFigures a_to_b, b_to_a;  ///< distances to the nearest point
  DistanceFigures a_to_surface, b_to_surface;  ///< distances to the surface of the other scan
  double chamfer_m = 0;  ///< mean over frames of the sum of both mean distances to the nearest
                         ///< point
  std::vector<WorstFrame> worst;  ///< frames with the largest Chamfer distance
};

/// Compares the scans of every lidar that both machines have. Scans are compared in the sensor
/// frame, so differences of position or attitude increase the distances. DistancesFrom and PairRays
/// describe the model.
std::vector<ScanComparison> CompareScans(const RecordedMachine& a, const RecordedMachine& b,
                                         std::size_t every);

std::string ScanTable(const ScanComparison& comparison);

}  // namespace tera
