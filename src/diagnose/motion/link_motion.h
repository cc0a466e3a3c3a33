#pragma once

#include <Eigen/Geometry>

#include "core/units.h"
#include "diagnose/motion/kinematic_chain.h"

/// Rigid kinematics from the base to a point of a link. The scalar is a template parameter for
/// automatic differentiation (ceres::Jet).

namespace tera {

template <typename T>
using Vector3 = Eigen::Matrix<T, 3, 1>;
template <typename T>
using Matrix3 = Eigen::Matrix<T, 3, 3>;

/// R = Rz(yaw) Ry(pitch) Rx(roll); the argument is (roll, pitch, yaw).
template <typename T>
Matrix3<T> RotationOfRpy(const Vector3<T>& rpy) {
  using std::cos, std::sin;
  const T cr = cos(rpy[0]), sr = sin(rpy[0]), cp = cos(rpy[1]), sp = sin(rpy[1]), cy = cos(rpy[2]),
          sy = sin(rpy[2]);
  Matrix3<T> R;
  R << cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr, sy * cp, sy * sp * sr + cy * cr,
      sy * sp * cr - cy * sr, -sp, cp * sr, cp * cr;
  return R;
}

template <typename T>
Matrix3<T> RotationAbout(const Vec3& axis, const T& angle) {
  using std::cos, std::sin;
  const T c = cos(angle), s = sin(angle), v = T(1) - c;
  Matrix3<T> R;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) R(i, j) = v * (axis[i] * axis[j]);
  }
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    R(i, i) += c;
    R(k, j) += s * axis[i];
    R(j, k) -= s * axis[i];
  }
  return R;
}

/// Measurement of an ideal inertial unit, all vectors in its own frame.
template <typename T>
struct Inertial {
  Vector3<T> w;
  Vector3<T> alpha;  ///< derivative of the turn rate
  Vector3<T> f;      ///< specific force at the origin of the frame
};

/// Measurement in the base frame. `d` and `dd` are the derivatives of (roll, pitch, yaw); `a_W` is
/// the acceleration of the base in W.
template <typename T>
Inertial<T> InertialOfBase(const Vector3<T>& rpy, const Vector3<T>& d, const Vector3<T>& dd,
                           const Vector3<T>& a_W) {
  using std::cos, std::sin;
  const T cr = cos(rpy[0]), sr = sin(rpy[0]), cp = cos(rpy[1]), sp = sin(rpy[1]);
  Inertial<T> base;
  base.w << d[0] - d[2] * sp, d[1] * cr + d[2] * sr * cp, d[2] * cr * cp - d[1] * sr;
  base.alpha << dd[0] - dd[2] * sp - d[2] * d[1] * cp,
      dd[1] * cr - d[1] * d[0] * sr + dd[2] * sr * cp + d[2] * d[0] * cr * cp -
          d[2] * d[1] * sr * sp,
      dd[2] * cr * cp - d[2] * d[0] * sr * cp - d[2] * d[1] * cr * sp - dd[1] * sr -
          d[1] * d[0] * cr;
  Vector3<T> f_W = a_W;
  f_W[2] += T(kStandardGravity_mps2);
  base.f = RotationOfRpy<T>(rpy).transpose() * f_W;
  return base;
}

/// Measurement in a frame C rigidly attached to the frame P of `at`. R_PC and r_P are rotation and
/// origin of C in P.
template <typename T, typename R>
Inertial<T> InertialBeside(const Inertial<T>& at, const Mat3& R_PC, const Vector3<R>& r_P) {
  const Mat3 R_CP = R_PC.transpose();
  return {R_CP * at.w, R_CP * at.alpha,
          R_CP * (at.f + at.alpha.cross(r_P) + at.w.cross(at.w.cross(r_P)))};
}

/// Measurement in a frame that is rotated about a unit axis by an angle with cosine `c` and sine
/// `s`.
template <typename T>
Inertial<T> InertialTurned(const Inertial<T>& at, const Vec3& axis, const T& c, const T& s) {
  const auto turned = [&](const Vector3<T>& v) -> Vector3<T> {
    return v * c - axis.cross(v) * s + axis.cast<T>() * (axis.dot(v) * (T(1) - c));
  };
  return {turned(at.w), turned(at.alpha), turned(at.f)};
}

/// Measurement in the link of a chain. `at` is the measurement in the base; `q`, `qd` and `qdd` are
/// position, rate and acceleration of each joint of the chain.
template <typename T>
Inertial<T> InertialOfLink(const KinematicChain& chain, Inertial<T> at, const T* q, const T* qd,
                           const T* qdd) {
  using std::cos, std::sin;
  for (std::size_t s = 0; s < chain.steps.size(); ++s) {
    const KinematicChain::Step& step = chain.steps[s];
    const Mat3 R_PJ = step.X_PJ.linear();
    const Vector3<T> axis = step.axis_J.cast<T>();
    const Vec3 r_P = step.X_PJ.translation();
    if (step.slides) {
      at = InertialBeside<T, T>(at, R_PJ, r_P.cast<T>() + (R_PJ * step.axis_J).cast<T>() * q[s]);
      at.f += axis * qdd[s] + at.w.cross(axis * (T(2) * qd[s]));
    } else {
      at = InertialTurned<T>(InertialBeside<T, double>(at, R_PJ, r_P), step.axis_J, cos(q[s]),
                             sin(q[s]));
      at.alpha += axis * qdd[s] + at.w.cross(axis * qd[s]);
      at.w += axis * qd[s];
    }
  }
  return InertialBeside<T, double>(at, chain.X_PL.linear(), chain.X_PL.translation());
}

/// Position in the base of a point of the link.
template <typename T>
Vector3<T> PointInBase(const KinematicChain& chain, const Vector3<T>& p_L, const T* q) {
  Vector3<T> p = chain.X_PL.linear().cast<T>() * p_L + chain.X_PL.translation().cast<T>();
  for (std::size_t s = chain.steps.size(); s-- > 0;) {
    const KinematicChain::Step& step = chain.steps[s];
    if (step.slides) {
      p += step.axis_J.cast<T>() * q[s];
    } else {
      p = RotationAbout<T>(step.axis_J, q[s]) * p;
    }
    p = step.X_PJ.linear().cast<T>() * p + step.X_PJ.translation().cast<T>();
  }
  return p;
}

}  // namespace tera
