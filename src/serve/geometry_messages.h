#pragma once

#include "core/motion.h"
#include "tera/v1/simulation.pb.h"

namespace tera {

inline void Put(const Vec3& v, v1::Vector3* message) {
  message->set_x(v.x());
  message->set_y(v.y());
  message->set_z(v.z());
}

inline void Put(const Pose& X, v1::Pose* message) {
  Put(Vec3(X.translation()), message->mutable_position_m());
  const Quat q(X.linear());
  v1::Quaternion& rotation = *message->mutable_rotation();
  rotation.set_w(q.w());
  rotation.set_x(q.x());
  rotation.set_y(q.y());
  rotation.set_z(q.z());
}

inline Vec3 Vec3Of(const v1::Vector3& message) {
  return Vec3(message.x(), message.y(), message.z());
}

}  // namespace tera
