#include "soil/track/rolling.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"

namespace tera {
namespace {

constexpr double kPeakAtNoSlip = 0.40, kPeakWithSlip = 0.15;  ///< c1, c2
constexpr double kMostEntry_rad = 80 * kDeg;  ///< no rim enters the ground further up
constexpr double kLeastEntry_rad = 1e-3;      ///< less is a wheel on what does not yield
constexpr double kLeastEase = 1e-3;           ///< ground below the axle of a wheel that rolls
constexpr double kSame = 1e-6;                ///< rounding of places in m and of directions

}  // namespace

Rolling::Rolling(const RunningGear& gear) : at_(gear.patches.size()) { FindWheels(gear); }

/// Patches on one circle, in their order along it, have p = axle + radius n each. They are a wheel
/// if they lie to both sides of straight down.
void Rolling::FindWheels(const RunningGear& gear) {
  const auto angle_rad = [&](std::size_t k) {
    const Vec3& n_B = gear.patches[k].outward_B;
    return std::atan2(n_B.x(), -n_B.z());
  };
  for (std::size_t first = 0, last = 0; first + 1 < gear.patches.size(); first = last + 1) {
    const ContactPatch& a = gear.patches[first];
    const ContactPatch& b = gear.patches[first + 1];
    last = first;
    const Vec3 turn = b.outward_B - a.outward_B;
    if (turn.norm() < kSame) continue;
    const double radius_m = (b.p_B_m - a.p_B_m).dot(turn) / turn.squaredNorm();
    const Vec3 axle_B_m = a.p_B_m - radius_m * a.outward_B;
    while (last + 1 < gear.patches.size()) {
      const ContactPatch& next = gear.patches[last + 1];
      if ((next.p_B_m - radius_m * next.outward_B - axle_B_m).norm() > kSame) break;
      ++last;
    }
    if (angle_rad(first) * angle_rad(last) >= 0) continue;
    for (std::size_t k = first; k <= last; ++k) {
      at_[k] = {static_cast<int>(wheels_.size()), angle_rad(k)};
    }
    wheels_.push_back({axle_B_m, radius_m});
  }
}

void Rolling::Advance(double forward_m, double shoe_m, double contact_m, const Pose& X_WB,
                      const Columns& ground) {
  if (contact_m <= 0 || wheels_.empty()) return;
  const double length_m = contact_m / wheels_.size();
  slipped_ =
      (slipped_ * length_m + std::abs(forward_m - shoe_m)) / (length_m + std::abs(forward_m));
  for (Wheel& wheel : wheels_) {
    wheel.rolled = std::clamp(wheel.rolled + shoe_m / length_m, -1.0, 1.0);
    const double side = wheel.rolled < 0 ? -1 : 1;
    // The rim enters where it meets ground as high as a column beyond where it did before.
    const double ahead_m = wheel.radius_m * std::sin(wheel.entry_rad) + ground.cell_m();
    const Vec3 axle_W = X_WB * wheel.axle_B_m;
    Vec3 q_W = axle_W + side * ahead_m * X_WB.linear().col(0);
    q_W.z() = ground.SampleAt(q_W.x(), q_W.y()).top_m;
    const double cosine = (axle_W - q_W).dot(X_WB.linear().col(2)) / wheel.radius_m;
    wheel.entry_rad = std::acos(std::clamp(cosine, std::cos(kMostEntry_rad), 1.0));
  }
}

double Rolling::Ease(std::size_t k, double along_m, double pressed_m, double pen_m) const {
  if (at_[k].wheel < 0) return 1;
  const double slip = slipped_ / (1 + slipped_);
  const double slip_ease = (1 - 0.5 * slip) / (1 + slip);
  const Wheel& wheel = wheels_[at_[k].wheel];
  const double entry_rad = wheel.entry_rad;
  const double theta_rad =
      (wheel.rolled < 0 ? -1 : 1) * (at_[k].angle_rad - along_m / wheel.radius_m);
  const double peak_rad = (kPeakAtNoSlip + kPeakWithSlip * slip) * entry_rad;
  if (theta_rad >= peak_rad || entry_rad < kLeastEntry_rad) return slip_ease;
  double behind_peak = 0;
  if (theta_rad > 0) {
    const double mirrored_rad = entry_rad - theta_rad / peak_rad * (entry_rad - peak_rad);
    behind_peak = (std::cos(mirrored_rad) - std::cos(entry_rad)) /
                  (std::cos(theta_rad) - std::cos(entry_rad));
  }
  const double plastic = std::abs(wheel.rolled) * pressed_m / (pressed_m + pen_m);
  return std::max(kLeastEase, slip_ease * (1 - plastic * (1 - behind_peak)));
}

}  // namespace tera
