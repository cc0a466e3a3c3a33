#pragma once

#include <LinearMath/btTransform.h>

#include "core/motion.h"

/// Eigen to Bullet and back. For the .cpp files of this folder only.

namespace tera {

inline btVector3 ToBullet(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
inline Vec3 FromBullet(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

inline btQuaternion ToBullet(const Mat3& R) {
  const Quat q(R);
  return {q.x(), q.y(), q.z(), q.w()};
}
inline Mat3 FromBullet(const btQuaternion& q) {
  return Quat(q.w(), q.x(), q.y(), q.z()).normalized().toRotationMatrix();
}

inline btTransform ToBullet(const Pose& X) {
  return btTransform(ToBullet(Mat3(X.linear())), ToBullet(Vec3(X.translation())));
}

}  // namespace tera
