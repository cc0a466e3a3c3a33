#include "soil/track/plate.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "core/units.h"

namespace tera {
namespace {

/// Share of critical damping. Half of it is radiation into the ground, for a footing as large and
/// heavy as the tracks of a machine (Lysmer and Richart 1966). The other half is hysteresis of soil
/// and shoes (estimate).
constexpr double kDampingRatio = 0.6;

/// Bounds of x^n for x > 0 and n up to 2. The bit pattern of a float is its base-2 logarithm,
/// linear between powers of 2. The linear value is at most 0.0861 below the logarithm. So x^n lies
/// between 2^-0.0861 and 2^(0.0861 n) times the linear result.
struct PowerBounds {
  float low, high;
};
PowerBounds RoughPower(float x, float n) {
  constexpr float kOneBits = 1065353216.0f;  // bit pattern of 1.0f
  constexpr float kLeastBits = 1 << 23, kMostBits = 2139095039.0f;
  constexpr float kRoughLow = 0.94f, kRoughHigh = 0.064f;
  const float bits = kOneBits + n * (static_cast<float>(std::bit_cast<std::int32_t>(x)) - kOneBits);
  const auto power =
      std::bit_cast<float>(static_cast<std::int32_t>(std::clamp(bits, kLeastBits, kMostBits)));
  return {kRoughLow * power, (1 + kRoughHigh * n) * power};
}

}  // namespace

Plate::Plate(const SoilType& soil, const ContactPatch& patch)
    : soil_(&soil),
      tan_friction_(std::tan(soil.shear_friction_rad)),
      face_(soil),
      width_m_(PlateWidth_m(patch)),
      rebound_papm_(Rebound_papm(soil, width_m_)),
      heave_reach_m_(HeaveReach_m(soil, width_m_)),
      limit_(LimitUnderGear(soil, width_m_)),
      modulus_npm_n2_(static_cast<float>(BekkerPressure_pa(soil, width_m_, 1))),
      exponent_(static_cast<float>(soil.sinkage_exponent)) {
  const double one_npm = BulldozingResistance_n(soil, 1, 1);
  const double two_npm = BulldozingResistance_n(soil, 1, 2);  // 2 a + 4 b, where one_npm is a + b
  pushed_npm3_ = 0.5 * two_npm - one_npm;
  pushed_npm2_ = one_npm - pushed_npm3_;
}

double Plate::Pressure_pa(double z_m) const {
  if (z_m <= 0) return 0;
  return std::min(BekkerPressure_pa(*soil_, width_m_, z_m), limit_.At_pa(z_m));
}

bool Plate::Bears(double pressure_pa, double z_m) const {
  constexpr double kSure = 1e-4;
  if (z_m <= 0) return pressure_pa <= 0;
  if (pressure_pa > limit_.At_pa(z_m)) return false;
  const PowerBounds rough = RoughPower(static_cast<float>(z_m), exponent_);
  if (pressure_pa < modulus_npm_n2_ * rough.low) return true;
  if (pressure_pa > modulus_npm_n2_ * rough.high) return false;
  const double about_pa = modulus_npm_n2_ * std::pow(static_cast<float>(z_m), exponent_);
  if (pressure_pa < (1 - kSure) * about_pa) return true;
  if (pressure_pa > (1 + kSure) * about_pa) return false;
  return pressure_pa <= BekkerPressure_pa(*soil_, width_m_, z_m);
}

double Plate::DampedPressure_pa(double share, double pen_m, double bearing_m,
                                double into_mps) const {
  const double stiffness_papm = share * rebound_papm_;
  double pressure_pa = stiffness_papm * pen_m;
  if (!Bears(pressure_pa, bearing_m)) {
    pressure_pa = Pressure_pa(bearing_m);
  }
  const double damping =
      2 * kDampingRatio * std::sqrt(stiffness_papm * pressure_pa / kStandardGravity_mps2);
  return pressure_pa + std::clamp(damping * into_mps, -pressure_pa, pressure_pa);
}

double Plate::PlasticSinkage_m(double share, double ease, double pressed_m, double pen_m) const {
  constexpr int kSteps = 12;
  constexpr double kClose_m = 1e-7;
  const double stiffness_papm = share * rebound_papm_;
  if (Bears(stiffness_papm * pen_m, ease * pressed_m)) return 0;
  double low = 0, high = pen_m, ds = pressed_m > 0 ? 0 : pen_m;
  for (int step = 0; step < kSteps; ++step) {
    const double z = pressed_m + ds;
    const double bekker_pa = BekkerPressure_pa(*soil_, width_m_, ease * z);
    const double limit_pa = limit_.At_pa(ease * z);
    const double residual = std::min(bekker_pa, limit_pa) - stiffness_papm * (pen_m - ds);
    (residual > 0 ? high : low) = ds;
    const double slope =
        bekker_pa > limit_pa
            ? stiffness_papm + ease * limit_.per_depth_papm
            : stiffness_papm + soil_->sinkage_exponent * bekker_pa / std::max(z, kClose_m);
    double next = ds - residual / slope;
    if (next <= low || next >= high) next = 0.5 * (low + high);
    const bool close = std::abs(next - ds) < kClose_m;
    ds = next;
    if (close) break;
  }
  return ds;
}

double Plate::PressingWork_jpm2(double from_m, double to_m) const {
  const double bekker_jpm2 =
      BekkerWork_jpm2(*soil_, width_m_, to_m) - BekkerWork_jpm2(*soil_, width_m_, from_m);
  return std::min(bekker_jpm2, (to_m - from_m) * limit_.At_pa(0.5 * (from_m + to_m)));
}

double Plate::BulldozingWork_jpm2(double from_m, double to_m) const {
  return pushed_npm2_ * (to_m - from_m) + pushed_npm3_ * (to_m * to_m - from_m * from_m);
}

std::vector<Plate> PlatesOf(const RunningGear& gear, const std::vector<SoilType>& soils) {
  std::vector<Plate> plates;
  for (const ContactPatch& patch : gear.patches) {
    for (const SoilType& soil : soils) plates.emplace_back(soil, patch);
  }
  return plates;
}

}  // namespace tera
