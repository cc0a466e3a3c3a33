#pragma once

#include "soil/soil.h"

namespace tera {

/// How much softer ground is under a wheel that rolls and slips than under a plate. It bears like
/// Bekker's plate at a share of its sinkage, p = p_B(share z).
///
/// Model   The stress at theta from straight down is greatest at theta_m = (c1 + c2 i) theta_1,
///         theta_1 where the rim enters the ground. It falls off to nothing below the axle. Behind
///         theta_m the share has the factor (cos theta' - cos theta_1) / (cos theta - cos theta_1),
///         theta' = theta_1 - theta (theta_1 - theta_m) / theta_m. To the side likewise, the share
///         falls off from the leading edge to the trailing one, by the sine of the slip angle. Both
///         are as much nearer to 1 as the wheel has not come over its contact's length yet, or as
///         its sinkage is elastic.
///         Slip and skid dig a wheel in. Their part d of the sinkage z bears nothing: the share is
///         1 - min(d / z, f / (1 + f)). Slip i digs d = g (K + h / 2), g = 1.3 (1 - exp(-(i /
///         0.42)^2)), K the soil's shear displacement and h the height of grousers. Skid digs as
///         much with g = 3.5 times the skid squared. Where a plate would hardly sink, digging is at
///         most f = 6 g times the sinkage that bears.
/// Source  Wong and Reece 1967, J. Terramechanics 4(1): peak and rear of the stress, with c1 = 0.4
///         and c2 = 0.15 of the ranges in Ishigami, Miwa, Nagatani and Yoshida 2007, J. Field
///         Robotics 24(3). Digging by slip: fitted to two single-wheel tests of smooth wheels, Ding
///         et al. 2011, J. Terramechanics 48(1), and Pavlov and Johnson's data (robomechanics,
///         3d-terramechanics), whose soils, loads and radii differ threefold; h / 2 to the lugged
///         wheel of the first. Skid: the second. Sideways: by analogy. See docs/evidence/soil.md.
struct Rolling {
  double slip = 0;    ///< i: 1 - v / (r w), 0 to 1, over the contact so far
  double skid = 0;    ///< 1 - r w / v, 0 to 1
  double rolled = 0;  ///< -1 to 1: contact's length, forwards, or further
  double aside = 0;   ///< -1 to 1: of its way, to the left

  /// Share of the sinkage `deep_m` of a wheel's lowest point that still bears load; what slip and
  /// skid have dug bears nothing.
  double BearingShare(const SoilType& soil, double grouser_m, double deep_m) const;
  /// A place on its rim, `pen_m` in ground that has been pressed in by `pressed_m`.
  struct Place {
    double angle_rad;  ///< from straight down, positive to the side to which it rolls
    double across;     ///< -1 to 1, from its right edge to its left
    double pressed_m, pen_m;
  };
  /// The same there.
  double ShareAt(const Place& place, double entry_rad, double bearing_share) const;
};

/// Ground that a wheel has met of late: averages over the contact's length.
class RollingMemory {
 public:
  /// In a step it goes `forward_m` ahead and `aside_m` to a side, its rim `shoe_m` under it, over a
  /// contact `length_m` long.
  void Advance(double forward_m, double aside_m, double shoe_m, double length_m);
  Rolling State() const;

 private:
  double slipped_ = 0;  ///< way of the rim less that of the wheel, over the latter
  double rolled_ = 0, aside_ = 0;
};

}  // namespace tera
