#include "physics/dynamics/static_walls.h"

#include "physics/dynamics/bullet_types.h"

namespace tera {

StaticWalls::StaticWalls(const SiteWalls& walls, double friction, btMultiBodyDynamicsWorld* world)
    : world_(world) {
  for (std::size_t t = 0; t + 2 < walls.indices.size(); t += 3) {
    const std::uint32_t* i = &walls.indices[t];
    const btVector3 a = ToBullet(walls.corners_W_m[i[0]]), b = ToBullet(walls.corners_W_m[i[1]]),
                    c = ToBullet(walls.corners_W_m[i[2]]);
    // Either way about: out of a triangle's back Bullet pushes a box too little.
    triangles_.addTriangle(a, b, c);
    triangles_.addTriangle(a, c, b);
  }
  const bool compressed = true;
  shape_ = std::make_unique<btBvhTriangleMeshShape>(&triangles_, compressed);
  body_ = std::make_unique<btRigidBody>(0.0, nullptr, shape_.get());
  body_->setFriction(friction);
  body_->setUserPointer(&tag_);
  world->addRigidBody(body_.get(), btBroadphaseProxy::StaticFilter,
                      btBroadphaseProxy::DefaultFilter);
}

}  // namespace tera
