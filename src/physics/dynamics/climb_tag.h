#pragma once

#include <BulletCollision/CollisionDispatch/btCollisionObject.h>

#include <limits>

namespace tera {

/// User pointer of a collider: climbing height of a link, or height of an obstacle.
struct ClimbTag {
  double climb_m = 0;
  double rise_m = std::numeric_limits<double>::infinity();
};

/// True if one of the colliders drives over the other without collision.
inline bool DrivesOver(const btCollisionObject& a, const btCollisionObject& b) {
  const auto* tag_a = static_cast<const ClimbTag*>(a.getUserPointer());
  const auto* tag_b = static_cast<const ClimbTag*>(b.getUserPointer());
  return tag_a && tag_b && (tag_a->rise_m <= tag_b->climb_m || tag_b->rise_m <= tag_a->climb_m);
}

}  // namespace tera
