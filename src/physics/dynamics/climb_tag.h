#pragma once

#include <BulletCollision/CollisionDispatch/btCollisionObject.h>

#include <limits>

namespace tera {

/// What a collider's user pointer shows: how high it climbs if it is a link's, how high it rises if
/// it is an obstacle's.
struct ClimbTag {
  double climb_m = 0;
  double rise_m = std::numeric_limits<double>::infinity();
};

/// Whether one of the two drives over the other rather than collide with it.
inline bool DrivesOver(const btCollisionObject& a, const btCollisionObject& b) {
  const auto* tag_a = static_cast<const ClimbTag*>(a.getUserPointer());
  const auto* tag_b = static_cast<const ClimbTag*>(b.getUserPointer());
  return tag_a && tag_b && (tag_a->rise_m <= tag_b->climb_m || tag_b->rise_m <= tag_a->climb_m);
}

}  // namespace tera
