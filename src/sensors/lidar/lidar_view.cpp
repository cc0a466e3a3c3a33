#include "sensors/lidar/lidar_view.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"

namespace tera {
namespace {

constexpr double kPoint_bytes = 16;  ///< coordinates and intensity in single precision

/// Elevation borders between neighbouring beams: midpoints, and mirrored midpoints at both ends. A
/// single beam has no borders.
std::vector<double> Borders(const std::vector<double>& sorted) {
  std::vector<double> borders;
  if (sorted.size() < 2) return borders;
  borders.push_back(sorted[0] - 0.5 * (sorted[1] - sorted[0]));
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    borders.push_back(0.5 * (sorted[i - 1] + sorted[i]));
  }
  borders.push_back(sorted.back() + 0.5 * (sorted.back() - sorted[sorted.size() - 2]));
  return borders;
}

}  // namespace

ViewField ViewOf(const LidarModel& model, double rate_hz) {
  std::vector<double> elevation_rad = model.elevation_rad;
  std::sort(elevation_rad.begin(), elevation_rad.end());
  const std::vector<double> borders_rad = Borders(elevation_rad);
  const double column_rad = 2 * kPi / model.columns;
  ViewField view;
  view.per_steradian = [borders_rad, column_rad](const Vec3& d_S) {
    const double at_rad = std::asin(std::clamp(d_S.z(), -1.0, 1.0));
    const auto above = std::upper_bound(borders_rad.begin(), borders_rad.end(), at_rad);
    if (above == borders_rad.begin() || above == borders_rad.end()) return 0.0;
    return 1.0 / (column_rad * (std::sin(*above) - std::sin(*(above - 1))));
  };
  view.is_flat = borders_rad.empty() || borders_rad.back() <= borders_rad.front();
  view.reach_m = [equation = RangeEquation(model), most_m = model.max_range_m](double returned) {
    return std::min(most_m, equation.Reach_m(returned));
  };
  view.nearest_m = view.min_distance_m = model.min_range_m;
  view.max_distance_m = model.max_range_m;
  view.distance_sigma_m = [model](double) { return model.range_noise_m; };
  view.bytes_per_sample = kPoint_bytes;
  view.samples_per_s = rate_hz * static_cast<double>(elevation_rad.size()) * model.columns;
  return view;
}

}  // namespace tera
