#pragma once

#include <Eigen/Core>

#include "diagnose/motion/kinematic_chain.h"

namespace tera {

/// Numbers whose motion splines describe: the base's place in W, its roll, pitch and yaw, then the
/// joints with an estimated motion.
inline constexpr int kBaseNumbers = 6;
inline constexpr int kRoll = 3, kYaw = 5;

/// A part that rises beside an antenna, as a boom.
///
/// Its reflection shifts a place by (h cos a, h sin a, v cos a) r, a = A - azimuth. A is the part's
/// azimuth and r the sine of its elevation. The shift is linear in (h cos azimuth, h sin azimuth, v
/// cos azimuth, v sin azimuth) where r (cos A, sin A) is known.
struct RaisedPart {
  KinematicChain chain;
  Vec3 direction_L = Vec3::UnitX();  ///< from its foot to its tip

  /// r (cos A, sin A) in W with the numbers of a motion; zero for a part that hangs or stands
  /// upright.
  Eigen::Vector2d At(const Eigen::VectorXd& numbers) const;
};

/// The derivatives of a place in W by those four numbers.
Eigen::Matrix<double, 3, 4> ByReflection(const Eigen::Vector2d& raised);

}  // namespace tera
