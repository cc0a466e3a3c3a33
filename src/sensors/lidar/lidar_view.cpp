#include "sensors/lidar/lidar_view.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/units.h"
#include "render/air/rain.h"
#include "render/air/weather.h"
#include "sensors/lidar/air_echoes.h"

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

/// Power below which fog hides a surface from a beam that reports one return; 0: it never does.
double PowerOfFog(const LidarModel& model, const RangeEquation& equation, double fog_1pm,
                  double extinction_1pm) {
  const bool reports_it_too = model.beam && (model.beam->returns > 1 || model.beam->pick == "last");
  if (fog_1pm <= 0 || reports_it_too) return 0;
  const double pulse_m = PulseLength_m(model.beam);
  const double range_m = model.min_range_m + 0.5 * pulse_m;
  const double reflectance =
      kPi * FogBackscatter_1pmsr(fog_1pm) * pulse_m * std::exp(-2 * extinction_1pm * range_m);
  if (reflectance < equation.LeastAir(range_m)) return 0;
  const bool is_first = model.beam && model.beam->pick == "first";
  return is_first ? std::numeric_limits<double>::infinity() : equation.Power(reflectance, range_m);
}

/// Pulses of a pattern per steradian, by cells of equal solid angle.
class PatternDensity {
 public:
  PatternDensity(const ScanPattern& pattern, int pulses_per_scan) : counts_(kRows * kTurns) {
    for (int pulse = 0; pulse < kPulses; ++pulse) {
      ++counts_[CellOf(pattern.Direction(static_cast<std::uint64_t>(pulse)))];
    }
    constexpr double kCell_sr = 4 * kPi / (kRows * kTurns);
    per_count_ = static_cast<double>(pulses_per_scan) / kPulses / kCell_sr;
  }
  double operator()(const Vec3& d_S) const { return per_count_ * counts_[CellOf(d_S)]; }

 private:
  static constexpr int kRows = 90, kTurns = 180;  ///< 2 deg about the horizon
  static constexpr int kPulses = 1 << 20;         ///< 65 a cell, if spread over the sphere

  static std::size_t CellOf(const Vec3& d_S) {
    const double row = 0.5 * (1 + d_S.z()) * kRows;
    const double turn = (std::atan2(d_S.y(), d_S.x()) / (2 * kPi) + 0.5) * kTurns;
    return std::clamp(static_cast<int>(row), 0, kRows - 1) * kTurns +
           std::clamp(static_cast<int>(turn), 0, kTurns - 1);
  }

  std::vector<int> counts_;
  double per_count_ = 0;
};

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
  if (model.pattern) {
    view.per_steradian = PatternDensity(*model.pattern, model.columns);
    view.is_flat = false;
  }
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

double ReachInAir_m(const LidarModel& model, const SensedAir& air, double returned) {
  const RangeEquation equation(model);
  if (!equation.limits()) return model.max_range_m;
  const double fog_1pm = FogExtinction_1pm(air.visibility_m);
  const double extinction_1pm =
      fog_1pm + Rain(air.rain_mmph).Extinction_1pm() + Snowfall(air.snowfall_mmph).Extinction_1pm();
  const double hides = PowerOfFog(model, equation, fog_1pm, extinction_1pm);
  const auto is_reported = [&](double range_m) {
    const double left = returned * std::exp(-2 * extinction_1pm * range_m);
    return left >= equation.LeastSurface(range_m) && equation.Power(left, range_m) > hides;
  };
  double near_m = 0, far_m = model.max_range_m;
  if (is_reported(far_m)) return far_m;
  // The power falls with the range, and what it needs does not.
  constexpr int kHalvings = 50;
  for (int k = 0; k < kHalvings; ++k) {
    const double middle_m = 0.5 * (near_m + far_m);
    (is_reported(middle_m) ? near_m : far_m) = middle_m;
  }
  return near_m;
}

}  // namespace tera
