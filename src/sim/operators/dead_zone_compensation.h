#pragma once

#include <limits>

namespace tera {

/// Parameters for learning the width of a dead zone. The defaults suit continuous motion. A joint
/// that must stop at a target needs more cautious values. "Ratio" is the joint's rate divided by
/// the rate of an ideal joint (without a dead zone) at the commanded lever.
struct DeadZoneAdaptation {
  /// Below this ideal lever, only a proportional part of the width is added.
  double transition = 0.05;
  double follow_ratio = 0.7;     ///< below this ratio a joint does not follow its lever
  double overshoot_ratio = 3.0;  ///< above this ratio the width is too large
  /// A joint that moves backwards with more than this ratio has overshot its target; the width then
  /// stays.
  double rebound_ratio = std::numeric_limits<double>::infinity();
  double wait_s = 0.4;    ///< time that a joint has to accelerate
  double rate_1ps = 0.5;  ///< rate of change of the width, in shares of full lever per second
};

/// Adaptive inverse of the dead zone between a lever and its joint's rate. The width of the zone is
/// learnt from the joint's motion, separately for each direction.
///
/// Model   u = v + d(sign v) min(1, |v| / transition). v is the lever for an ideal joint, u the
///         real lever, d the learnt width. If a joint does not follow a small v for `wait_s`, d
///         increases by `rate_1ps` until the joint moves at the wanted rate. If the joint is faster
///         than `overshoot_ratio` times that rate, d decreases at the same speed. Otherwise d
///         stays.
///         As long as d does not exceed the real zone, the joint is never faster than v commands,
///         even near v = 0. A feedback loop around it is then as stable as without a dead zone.
/// Omits   joints that their load holds: d does not change for |v| of 0.5 and more.
/// Source  Tao and Kokotovic 1994, "Adaptive control of plants with unknown dead-zones".
class DeadZoneCompensation {
 public:
  explicit DeadZoneCompensation(const DeadZoneAdaptation& adaptation = {})
      : adaptation_(adaptation) {}
  /// Real lever for the lever of an ideal joint. `rate_share` is the joint's current rate divided
  /// by its rate at full lever, with the sign of the lever.
  double Lever(double ideal_lever, double rate_share, double dt_s);

 private:
  DeadZoneAdaptation adaptation_;
  double width_[2] = {0, 0};  ///< d for v < 0 and for v >= 0
  bool positive_ = true;      ///< direction of v in the previous step
  double stalled_s_ = 0;      ///< time for which the joint has not followed in this direction
  bool growing_ = false;
};

}  // namespace tera
