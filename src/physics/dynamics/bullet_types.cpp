#include "physics/dynamics/bullet_types.h"

#include <LinearMath/btTransform.h>

namespace tera {

btVector3 ToBullet(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

btQuaternion ToBullet(const Mat3& R) {
  const Quat q(R);
  return {q.x(), q.y(), q.z(), q.w()};
}

btTransform ToBullet(const Pose& X) {
  return btTransform(ToBullet(Mat3(X.linear())), ToBullet(Vec3(X.translation())));
}

Vec3 FromBullet(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

Mat3 FromBullet(const btQuaternion& q) {
  return Quat(q.w(), q.x(), q.y(), q.z()).normalized().toRotationMatrix();
}

}  // namespace tera
