#include "physics/actuation/kinematic_gain.h"

#include <algorithm>
#include <cmath>

namespace tera {
namespace {

constexpr double kMostGain = 10;

double LeverArm_m(const KinematicGainParameters& p, double position_rad) {
  if (!p.arms_m.values.empty()) return p.arms_m.At(position_rad);
  const double angle_rad = p.angle_at_zero_rad + position_rad;
  // Law of cosines, in a form that rounding cannot make negative.
  const double half = std::sin(0.5 * angle_rad), difference_m = p.barrel_m - p.rod_m;
  const double length_m =
      std::sqrt(difference_m * difference_m + 4 * p.barrel_m * p.rod_m * half * half);
  if (length_m == 0) return 0;  // both pins coincide
  return p.barrel_m * p.rod_m * std::abs(std::sin(angle_rad)) / length_m;
}

}  // namespace

KinematicGainParameters KinematicGainOf(const Effects& effects) {
  KinematicGainParameters parameters;
  if (const Effect* lever = FindEffect(effects, "cylinder_lever")) {
    parameters.barrel_m = (*lever)["barrel_m"];
    parameters.rod_m = (*lever)["rod_m"];
    parameters.angle_at_zero_rad = (*lever)["angle_at_zero_rad"];
    parameters.reference_rad = (*lever)["reference_rad"];
  }
  if (const Effect* backlash = FindEffect(effects, "backlash")) {
    parameters.gap_rad = (*backlash)["gap_rad"];
  }
  return parameters;
}

KinematicGain::KinematicGain(const KinematicGainParameters& parameters)
    : parameters_(parameters), in_gap_rad_(0.5 * parameters.gap_rad) {
  acts_ = HasLever() || parameters_.gap_rad > 0;
  if (HasLever()) reference_arm_m_ = LeverArm_m(parameters_, parameters_.reference_rad);
}

double KinematicGain::Gain(double position_rad) const {
  if (!HasLever()) return 1;
  const double arm_m = LeverArm_m(parameters_, position_rad);
  return reference_arm_m_ / std::max(arm_m, reference_arm_m_ / kMostGain);
}

double KinematicGain::Act(double rate_radps, double position_rad, double dt_s) {
  if (HasLever()) rate_radps *= Gain(position_rad);
  if (parameters_.gap_rad <= 0) return rate_radps;
  const double moved_rad = in_gap_rad_ + rate_radps * dt_s;
  in_gap_rad_ = std::clamp(moved_rad, 0.0, parameters_.gap_rad);
  return (moved_rad - in_gap_rad_) / dt_s;
}

}  // namespace tera
