#include "soil/flow/layered_bank.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/units.h"

namespace tera {
namespace {

constexpr double kThinnest_m = 1e-6;
constexpr double kAngleStep_rad = 3 * kDeg;
/// resistance of a bank without cohesion, against division by zero
constexpr double kLeastHold_npm = 1e-3;

double OmegaAt_rad(int angle) { return (angle + 1) * kAngleStep_rad; }

}  // namespace

BankLayers::BankLayers(ColumnId k, double height_m, const Columns& ground) {
  const Column& c = ground.at(k);
  double rest_m = height_m;
  const auto add = [&](double d_m, std::uint8_t soil) {
    d_m = std::min(d_m, rest_m);
    rest_m -= d_m;
    if (count > 0 && (layer[count - 1].soil == soil || count == kMost)) {
      layer[count - 1].height_m += d_m;
    } else if (d_m > kThinnest_m) {
      layer[count++] = {d_m, soil};
    }
  };
  int n = c.layer_count;
  while (n > 0 && c.layers[n - 1].loose) --n;
  for (; n > 0 && rest_m > 0; --n) add(c.layers[n - 1].thickness_m, c.layers[n - 1].soil);
  for (double depth_m = c.ground_m - c.bank_m; rest_m > kThinnest_m;) {
    const Stratum& stratum = ground.ProfileOf(k).Below(depth_m);
    const double d_m = std::max(stratum.bottom_m - depth_m, kThinnest_m);
    add(d_m, stratum.soil);
    depth_m += d_m;
  }
}

double SlipSurface::HeightAt(double behind_m) const {
  double z_m = 0;
  for (int n = 0; n < count; ++n) {
    const double goes_m = part[n].height_m / part[n].tan_slope;
    if (behind_m < goes_m) return z_m + behind_m * part[n].tan_slope;
    behind_m -= goes_m;
    z_m += part[n].height_m;
  }
  return std::numeric_limits<double>::infinity();
}

double SlipSurface::length_m() const {
  double sum_m = 0;
  for (int n = 0; n < count; ++n) sum_m += part[n].height_m / part[n].tan_slope;
  return sum_m;
}

double SlipSurface::height_m() const {
  double sum_m = 0;
  for (int n = 0; n < count; ++n) sum_m += part[n].height_m;
  return sum_m;
}

LayeredBanks::LayeredBanks(const std::vector<SoilType>& soils) {
  for (const SoilType& type : soils) {
    const double phi_rad = type.friction_angle_rad, c_pa = type.cohesion_pa;
    Soil& soil = soils_.emplace_back();
    soil.weight_npm3 = type.bank_density_kgpm3 * kStandardGravity_mps2;
    soil.tan_friction = std::tan(phi_rad);
    soil.crack_m = 2 * c_pa / soil.weight_npm3 * std::tan(kPi / 4 + phi_rad / 2);
    for (int n = 0; n < kAngles; ++n) {
      const double slope_rad = OmegaAt_rad(n) + phi_rad;
      soil.goes[n] = slope_rad < kPi / 2 ? 1 / std::tan(slope_rad) : 0;
      soil.hold_pa[n] = c_pa * std::cos(phi_rad) / std::sin(slope_rad);
    }
  }
}

/// Slip surface whose `cracked` uppermost layers crack vertically.
SlipSurface LayeredBanks::SlipAt(std::span<const BankLayer> layers, int cracked, double run_m,
                                 int angle) const {
  SlipSurface slip;
  double height_m = 0;
  for (const BankLayer& layer : layers) height_m += layer.height_m;
  const double face = run_m / height_m;
  double z_m = 0, behind_m = 0, weight_npm = 0, hold_npm = 0, surface_m = 0;
  for (int n = static_cast<int>(layers.size()) - 1; n >= 0; --n) {
    const Soil& soil = soils_[layers[n].soil];
    const double d_m = layers[n].height_m;
    double goes_m = 0;
    if (n >= cracked) {
      if (soil.goes[angle] <= 0) return {};
      goes_m = d_m * soil.goes[angle];
      hold_npm += d_m * soil.hold_pa[angle];
      slip.part[slip.count++] = {d_m, 1 / soil.goes[angle]};
      surface_m += std::hypot(d_m, goes_m);
      slip.tan_friction += std::hypot(d_m, goes_m) * soil.tan_friction;
    }
    weight_npm += soil.weight_npm3 * d_m * (behind_m + 0.5 * goes_m - face * (z_m + 0.5 * d_m));
    behind_m += goes_m;
    z_m += d_m;
  }
  if (behind_m <= run_m) return {};
  slip.tan_friction /= surface_m;
  slip.drives_over_holds =
      std::max(0.0, weight_npm) * std::sin(OmegaAt_rad(angle)) / std::max(hold_npm, kLeastHold_npm);
  return slip;
}

SlipSurface LayeredBanks::LeastSafe(std::span<const BankLayer> layers, double run_m,
                                    double beyond_m) const {
  SlipSurface least;
  for (int cracked = 0; cracked < static_cast<int>(layers.size()); ++cracked) {
    for (int angle = 0; angle < kAngles; ++angle) {
      const SlipSurface slip = SlipAt(layers, cracked, run_m, angle);
      if (slip.drives_over_holds <= least.drives_over_holds) continue;
      if (slip.length_m() > beyond_m) least = slip;
    }
    // A layer thicker than its crack depth does not crack through.
    if (layers[cracked].height_m > soils_[layers[cracked].soil].crack_m) break;
  }
  return least;
}

}  // namespace tera
