#pragma once

#include <limits>

namespace tera {

/// How a hand feels for the lever that moves a joint. The defaults suit a task that goes on moving;
/// a joint that shall come to rest at a place is felt for more gently.
struct Touch {
  double soft = 0.05;  ///< lever below which it need not be had in full
  double slow = 0.7;   ///< a joint that moves at less of what is asked does not follow
  /// One that moves back by more of what is asked overshot: it is left alone.
  double back = std::numeric_limits<double>::infinity();
  double fast = 3.0;      ///< one that moves at more of what is asked is pushed too far
  double wait_s = 0.4;    ///< longer than a joint's run-up
  double push_1ps = 0.5;  ///< of the lever in a second
};

/// How far a lever has to be moved before its joint follows, felt from the joint's motion, for each
/// direction on its own.
///
/// Model   inverse of a dead band, u = v + d(sign v) min(1, |v| / soft), v being the lever that an
///         ideal joint would need. A joint that does not follow a small v for `wait_s` is pushed: d
///         grows by `push_1ps` until it moves as asked. One that moves at more than `fast` times of
///         it lets d shrink as fast. d stays once learnt, since the band stays. With d no larger
///         than the band the joint never moves faster than v asks, near v = 0 too, so that the
///         loop around it is as stable as without a band.
/// Omits   a joint held by its load: at v of 0.5 and beyond it is not pushed.
/// Source  Tao and Kokotovic 1994, "Adaptive control of plants with unknown dead-zones".
class LeverFeel {
 public:
  explicit LeverFeel(const Touch& touch = {}) : touch_(touch) {}
  /// The lever for the ideal lever `wanted`, while the joint moves at `moving` of its rate at full
  /// lever (signed, like `wanted`).
  double Lever(double wanted, double moving, double dt_s);

 private:
  Touch touch_;
  double band_[2] = {0, 0};  ///< d of v < 0 and of v >= 0
  bool positive_ = true;     ///< direction last wanted
  double slow_s_ = 0;        ///< how long the joint has been too slow in this direction
  bool pushing_ = false;
};

}  // namespace tera
