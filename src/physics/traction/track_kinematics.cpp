#include "physics/traction/track_kinematics.h"

#include <algorithm>
#include <cmath>

namespace tera {
namespace {

/// Slip x = i L / K, at most `most`, that mobilises the share `share` in [0, 1) of the strength. 1
/// - (1 - e^-x) / x is concave, so Newton's iterates from the left stay on the left.
double JanosiSlip(double share, double most) {
  constexpr int kSteps = 8;
  constexpr double kClose = 1e-10;
  if (share <= 0) return 0;
  if (share >= 1) return most;
  double x = std::max(2 * share, share / (1 - share));
  for (int step = 0; step < kSteps && x < most; ++step) {
    const double gone = std::expm1(-x), fallen = -gone / x;
    const double missing = share - (1 - fallen);
    if (missing < kClose) break;
    x += missing * x / (fallen - 1 - gone);
  }
  return std::min(x, most);
}

/// Slip of a track at `speed_mps` that needs `thrust`. Thrust is relative to the load and along x.
double SlipOf(double speed_mps, double thrust, double slope, const TrackGeometry& geometry,
              const TrackKinematicsParameters& p) {
  const double direction = speed_mps < 0 ? -1 : 1;
  const double along = direction * thrust + p.resistance;
  double slip = p.slip + p.slope_slip + p.slip_per_slope * slope * direction;
  slip += along / p.slip_stiffness;
  if (p.shear_modulus_m > 0) {
    const double k = p.shear_modulus_m / geometry.contact_length_m;
    slip += std::copysign(k * JanosiSlip(std::abs(along) / p.friction, 1 / k), along);
  }
  return std::clamp(slip, -1.0, 1.0);
}

/// Lower bound on the cosine of the tilt, for a machine on its side or its back. It keeps thrust
/// over load and the side slope finite. The slip, at most 1, reaches its bounds much earlier. The
/// slope along the tracks, the tangent of the pitch, needs no such bound.
constexpr double kLeastUpright = 1e-6;

/// Excess of `size` over `holding`, with the sign of `size`.
double Beyond(double size, double holding) {
  return std::copysign(std::max(0.0, std::abs(size) - holding), size);
}

}  // namespace

TrackKinematicsParameters TrackKinematicsOf(const Effects& base) {
  TrackKinematicsParameters p;
  if (const Effect* e = FindEffect(base, "track_scale")) p.scale = (*e)["scale"];
  if (const Effect* e = FindEffect(base, "track_asymmetry")) p.difference = (*e)["difference"];
  if (const Effect* e = FindEffect(base, "track_slip")) {
    p.slip = (*e)["slip"];
    p.shear_modulus_m = (*e)["shear_modulus_m"];
    p.friction = (*e)["friction"];
    p.turn_slip = (*e)["turn_slip"];
  }
  if (const Effect* e = FindEffect(base, "slope_slip")) {
    p.slope_slip = (*e)["slip"];
    p.slip_per_slope = (*e)["slip_per_slope"];
  }
  if (const Effect* e = FindEffect(base, "side_slip")) p.drift_per_slope = (*e)["drift_per_slope"];
  if (const Effect* e = FindEffect(base, "effective_gauge")) p.gauge_ratio = (*e)["ratio"];
  if (const Effect* e = FindEffect(base, "icr_shift")) {
    p.icr_forward_m = (*e)["forward_m"];
    p.icr_left_m = (*e)["left_m"];
  }
  if (const Effect* e = FindEffect(base, "rolling_resistance")) {
    p.resistance = (*e)["coefficient"];
    p.slip_stiffness = (*e)["slip_stiffness"];
  }
  if (const Effect* e = FindEffect(base, "digging_force")) {
    p.holding = (*e)["holding"];
    p.yield_mps = (*e)["yield_mps"];
  }
  return p;
}

TrackSpeeds ShoeSpeeds(const TrackSpeeds& nominal, const TrackKinematicsParameters& p) {
  return {p.scale * (1 - 0.5 * p.difference) * nominal.left_mps,
          p.scale * (1 + 0.5 * p.difference) * nominal.right_mps};
}

PlanarTwist MoveOnTracks(const TrackSpeeds& shoes, const TrackCircumstances& c,
                         const TrackGeometry& geometry, const TrackKinematicsParameters& p) {
  const double rise = -std::sin(c.pitch_rad);  // slope along x_B, as rise per metre
  const double level = std::cos(c.pitch_rad);
  const double side_rise = std::sin(c.roll_rad) * level;
  const double slope = rise / level;
  const double side_slope =
      side_rise / std::sqrt(std::max(kLeastUpright * kLeastUpright, 1 - side_rise * side_rise));
  const double load_n = geometry.weight_n * std::max(kLeastUpright, level * std::cos(c.roll_rad));
  const double even = (geometry.weight_n * rise - c.tool_force_B_n.x()) / load_n;
  const double turning = 2 * c.tool_torque_B_nm / geometry.gauge_m / load_n;

  const double left_mps =
      shoes.left_mps * (1 - SlipOf(shoes.left_mps, even + turning, slope, geometry, p));
  const double right_mps =
      shoes.right_mps * (1 - SlipOf(shoes.right_mps, even - turning, slope, geometry, p));
  const double fastest_mps = std::abs(shoes.left_mps) + std::abs(shoes.right_mps);
  const double turn =
      fastest_mps > 0 ? std::abs(shoes.right_mps - shoes.left_mps) / fastest_mps : 0.0;
  PlanarTwist twist;
  twist.yaw_radps = (right_mps - left_mps) / (p.gauge_ratio * geometry.gauge_m);
  twist.forward_mps =
      0.5 * (1 - p.turn_slip * turn) * (left_mps + right_mps) + twist.yaw_radps * p.icr_left_m;
  twist.left_mps =
      -twist.yaw_radps * p.icr_forward_m -
      p.drift_per_slope * side_slope * 0.5 * (std::abs(left_mps) + std::abs(right_mps));
  if (p.yield_mps <= 0) return twist;

  const double held_n = p.holding * geometry.weight_n;
  const double force_n = c.tool_force_B_n.norm();
  if (force_n > held_n) {
    const double drag_mps = p.yield_mps * (force_n - held_n) / geometry.weight_n;
    twist.forward_mps += drag_mps * c.tool_force_B_n.x() / force_n;
    twist.left_mps += drag_mps * c.tool_force_B_n.y() / force_n;
  }
  const double arm_m = geometry.contact_length_m / 4;
  twist.yaw_radps +=
      p.yield_mps * Beyond(c.tool_torque_B_nm / arm_m, held_n) / geometry.weight_n / arm_m;
  return twist;
}

}  // namespace tera
