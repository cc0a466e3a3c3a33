#pragma once

#include "soil/soil.h"

namespace tera {

/// Softening of the ground under a rolling, slipping wheel. The ground bears like Bekker's plate at
/// a share of its sinkage: p = p_B(share z).
///
/// Model   Along the rim: theta is the angle from straight down, theta_1 the angle at which the rim
///         enters the ground. The stress is greatest at theta_m = (c1 + c2 i) theta_1 for slip i,
///         and zero behind the axle. Behind theta_m the share has the factor (cos theta' - cos
///         theta_1) / (cos theta - cos theta_1), where theta' = theta_1 - theta (theta_1 - theta_m)
///         / theta_m.
///         Across the rim: the share falls from the leading to the trailing edge, by the sine of
///         the slip angle. Both effects start from a share of 1. They grow while the wheel rolls
///         over its contact length, and with the plastic part of the sinkage.
///         Digging: slip and skid dig a part d of the sinkage z, which bears nothing. The share has
///         the factor 1 - min(d / z, f / (1 + f)). Slip i digs d = g (K + h / 2) with g = 1.3 (1 -
///         exp(-(i / 0.42)^2)). K is the shear modulus of the soil in m, h the height of the
///         grousers. Skid adds 3.5 times its square to g. Where a plate would hardly sink, digging
///         is limited to f = 6 g times the bearing sinkage.
/// Source  Peak and rear of the stress: Wong and Reece 1967, J. Terramechanics 4(1). c1 = 0.4 and
///         c2 = 0.15 lie in the ranges of Ishigami, Miwa, Nagatani and Yoshida 2007, J. Field
///         Robotics 24(3). Digging by slip: fitted to two single-wheel tests of smooth wheels,
///         whose soils, loads and radii differ threefold. They are Ding et al. 2011, J.
///         Terramechanics 48(1), and the data of Pavlov and Johnson (robomechanics,
///         3d-terramechanics). h / 2: the lugged wheel of the first. Skid: the second. Sideways: by
///         analogy. See docs/evidence/soil.md.
struct Rolling {
  double slip = 0;    ///< i = 1 - v / (r w), 0 to 1, mean over the contact
  double skid = 0;    ///< 1 - r w / v, 0 to 1
  double rolled = 0;  ///< distance rolled over contact length, -1 to 1, positive forwards
  double aside = 0;   ///< sideways share of the way, -1 to 1, positive to the left

  /// Factor on the share of the sinkage, for soil that slip and skid have dug away. It is 1 without
  /// slip and skid. `deep_m` is the sinkage of the lowest point of the wheel.
  double BearingShare(const SoilType& soil, double grouser_m, double deep_m) const;
  /// A point on the rim, `pen_m` deep in ground with the plastic sinkage `pressed_m`.
  struct Place {
    double angle_rad;  ///< from straight down, positive in the direction of rolling
    double across;     ///< -1 to 1, from the right edge to the left edge
    double pressed_m, pen_m;
  };
  /// Share of the sinkage that bears load at a point of the rim.
  double ShareAt(const Place& place, double entry_rad, double bearing_share) const;
};

/// Recent motion of a wheel, averaged over its contact length.
class RollingMemory {
 public:
  /// Advances by one step: the wheel moves `forward_m` and `aside_m`, its rim moves `shoe_m`. The
  /// contact is `length_m` long.
  void Advance(double forward_m, double aside_m, double shoe_m, double length_m);
  Rolling State() const;

 private:
  /// (path of the rim - path of the wheel) / path of the wheel
  double slipped_ = 0;
  double rolled_ = 0, aside_ = 0;
};

}  // namespace tera
