#pragma once

#include "core/motion.h"

class btQuaternion;
class btTransform;
class btVector3;

/// Conversions between Eigen and Bullet.

namespace tera {

btVector3 ToBullet(const Vec3& v);
btQuaternion ToBullet(const Mat3& R);
btTransform ToBullet(const Pose& X);

Vec3 FromBullet(const btVector3& v);
Mat3 FromBullet(const btQuaternion& q);

}  // namespace tera
