#pragma once

#include <Eigen/Core>

#include "diagnose/motion/kinematic_chain.h"

namespace tera {

/// Coordinates of the base: position in W, then roll, pitch, yaw. The estimated joints follow.
inline constexpr int kBaseNumbers = 6;
inline constexpr int kRoll = 3, kYaw = 5;

/// A part that rises next to an antenna, such as a boom, and reflects satellite signals.
///
/// Model   the reflection shifts the measured position by (h cos a, h sin a, v cos a) r with a = A
///         - azimuth. A is the azimuth of the part and r the sine of its elevation. For known r
///         (cos A, sin A), the shift is linear in four numbers: (h cos azimuth, h sin azimuth, v
///         cos azimuth, v sin azimuth).
struct RaisedPart {
  KinematicChain chain;
  Vec3 direction_L = Vec3::UnitX();  ///< direction from foot to tip

  /// r (cos A, sin A) in W. Zero for a part that hangs down or stands upright.
  Eigen::Vector2d At(const Eigen::VectorXd& numbers) const;
};

/// Derivatives of the position in W by the four numbers of RaisedPart.
Eigen::Matrix<double, 3, 4> ByReflection(const Eigen::Vector2d& raised);

}  // namespace tera
