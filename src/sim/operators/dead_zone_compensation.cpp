#include "sim/operators/dead_zone_compensation.h"

#include <algorithm>
#include <cmath>

namespace tera {
namespace {

/// From this lever on, a joint that does not follow is held by its load, not by a dead zone.
constexpr double kLargestAdaptingLever = 0.5;
// Share of full lever; a valve with a wider dead zone counts as broken.
constexpr double kLargestWidth = 0.5;

}  // namespace

double DeadZoneCompensation::Lever(double ideal_lever, double rate_share, double dt_s) {
  const bool positive = ideal_lever >= 0;
  const double sign = positive ? 1 : -1;
  const double v = std::abs(ideal_lever), v_moving = sign * rate_share;
  const bool adapts = v > adaptation_.transition && v < kLargestAdaptingLever;
  if (!adapts || positive != positive_ || v_moving >= v) growing_ = false;
  const bool follows =
      v_moving >= adaptation_.follow_ratio * v || v_moving <= -adaptation_.rebound_ratio * v;
  stalled_s_ = adapts && positive == positive_ && !follows ? stalled_s_ + dt_s : 0;
  growing_ |= stalled_s_ > adaptation_.wait_s;
  positive_ = positive;

  double& width = width_[positive];
  if (growing_) width = std::min(width + adaptation_.rate_1ps * dt_s, kLargestWidth);
  if (adapts && v_moving > adaptation_.overshoot_ratio * v) {
    width = std::max(width - adaptation_.rate_1ps * dt_s, 0.0);
  }
  return std::clamp(ideal_lever + sign * width * std::min(1.0, v / adaptation_.transition), -1.0,
                    1.0);
}

}  // namespace tera
