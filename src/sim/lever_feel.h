#pragma once

namespace tera {

/// How far a lever has to be moved before its joint follows, felt from the joint's motion, for each
/// direction on its own.
///
/// Model   inverse of a dead band, u = v + d(sign v) min(1, |v| / 0.05), v being the lever that an
///         ideal joint would need. A joint that moves for 0.4 s at less than 0.7 of what a small v
///         asks is pushed: d grows by 0.5 a second until it moves as asked. One that moves at more
///         than 3 times of it lets d shrink as fast. d stays once learnt, since the band stays.
///         With d no larger than the band the joint never moves faster than v asks, near v = 0 too,
///         so that the loop around it is as stable as without a band.
/// Omits   a joint held by its load: at v of 0.5 and beyond it is not pushed.
/// Source  Tao and Kokotovic 1994, "Adaptive control of plants with unknown dead-zones".
class LeverFeel {
 public:
  /// The lever for the ideal lever `wanted`, while the joint moves at `moving` of its rate at full
  /// lever (signed, like `wanted`).
  double Lever(double wanted, double moving, double dt_s);

 private:
  double band_[2] = {0, 0};  ///< d of v < 0 and of v >= 0
  bool positive_ = true;     ///< direction last wanted
  double slow_s_ = 0;        ///< how long the joint has been too slow in this direction
  bool pushing_ = false;
};

}  // namespace tera
