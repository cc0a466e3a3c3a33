#pragma once

#include <limits>

namespace tera {

/// Adaptation of a dead zone's width. The defaults suit continuous motion; a joint that must come
/// to rest at a target needs gentler values. Ratios are joint rate over the rate that the lever
/// asks of an ideal joint.
struct DeadZoneAdaptation {
  double transition = 0.05;      ///< lever below which the width is added in proportion only
  double follow_ratio = 0.7;     ///< a joint below this ratio does not follow its lever
  double overshoot_ratio = 3.0;  ///< above this ratio the width is too large
  /// A joint that moves back by more than this ratio has overshot, and the width stays.
  double rebound_ratio = std::numeric_limits<double>::infinity();
  double wait_s = 0.4;    ///< time for a joint to accelerate
  double rate_1ps = 0.5;  ///< rate of the width, in shares of full lever
};

/// Adaptive inverse of the dead zone between a lever and the rate of its joint. It learns the
/// zone's width from the joint's motion, separately for each direction.
///
/// Model   u = v + d(sign v) min(1, |v| / transition), where v is the lever for an ideal joint. If
///         a joint does not follow a small v for `wait_s`, d grows by `rate_1ps` until the joint
///         moves as asked. If it moves faster than `overshoot_ratio` times v, d shrinks at the same
///         rate. d stays once learnt, since the dead zone stays. With d no larger than the zone,
///         the joint never moves faster than v commands, even near v = 0. The loop around it is
///         then as stable as without a dead zone.
/// Omits   a joint held by its load: d does not grow at v of 0.5 and beyond.
/// Source  Tao and Kokotovic 1994, "Adaptive control of plants with unknown dead-zones".
class DeadZoneCompensation {
 public:
  explicit DeadZoneCompensation(const DeadZoneAdaptation& adaptation = {})
      : adaptation_(adaptation) {}
  /// The lever at which a joint moves as an ideal joint would at `ideal_lever`. `rate_share` is the
  /// joint's rate over its rate at full lever, with the sign of the lever.
  double Lever(double ideal_lever, double rate_share, double dt_s);

 private:
  DeadZoneAdaptation adaptation_;
  double width_[2] = {0, 0};  ///< d for v < 0 and for v >= 0
  bool positive_ = true;      ///< direction of v in the previous step
  double stalled_s_ = 0;      ///< duration for which the joint has not followed in this direction
  bool growing_ = false;
};

}  // namespace tera
