#pragma once

#include <limits>

namespace tera {

/// How a dead zone's width is adapted. The defaults suit a task that goes on moving; a joint that
/// shall come to rest at a place needs gentler ones. Ratios are of the joint's rate to the rate
/// that the lever asks of an ideal joint.
struct DeadZoneAdaptation {
  double transition = 0.05;      ///< lever below which the width is added in proportion only
  double follow_ratio = 0.7;     ///< a joint below this ratio does not follow its lever
  double overshoot_ratio = 3.0;  ///< above this ratio the width is too large
  /// A joint that moves back by more than this ratio overshot: the width is left alone.
  double rebound_ratio = std::numeric_limits<double>::infinity();
  double wait_s = 0.4;    ///< time that a joint may take to run up
  double rate_1ps = 0.5;  ///< of the width, in shares of full lever
};

/// Adaptive inverse of the dead zone between a lever and the rate of its joint. The zone's width is
/// found from the joint's motion, for each direction on its own.
///
/// Model   u = v + d(sign v) min(1, |v| / transition), v being the lever that an ideal joint would
///         need. Where a joint does not follow a small v for `wait_s`, d grows by `rate_1ps` until
///         it moves as asked. Where it moves at more than `overshoot_ratio` of what v asks, d
///         shrinks as fast. d stays once learnt, since the dead zone stays. With d no larger than
///         the zone the joint never moves faster than v asks, near v = 0 too, so that the loop
///         around it is as stable as without a dead zone.
/// Omits   a joint held by its load: at v of 0.5 and beyond d does not grow.
/// Source  Tao and Kokotovic 1994, "Adaptive control of plants with unknown dead-zones".
class DeadZoneCompensation {
 public:
  explicit DeadZoneCompensation(const DeadZoneAdaptation& adaptation = {})
      : adaptation_(adaptation) {}
  /// The lever that makes a joint do what `ideal_lever` would make an ideal one do. `rate_share` is
  /// the joint's rate as a share of its rate at full lever, signed as the lever is.
  double Lever(double ideal_lever, double rate_share, double dt_s);

 private:
  DeadZoneAdaptation adaptation_;
  double width_[2] = {0, 0};  ///< d of v < 0 and of v >= 0
  bool positive_ = true;      ///< direction of v in the step before
  double stalled_s_ = 0;      ///< how long the joint has not followed in this direction
  bool growing_ = false;
};

}  // namespace tera
