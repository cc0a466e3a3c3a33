#pragma once

#include <BulletCollision/CollisionShapes/btBvhTriangleMeshShape.h>
#include <BulletCollision/CollisionShapes/btTriangleMesh.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>

#include <memory>

#include "physics/dynamics/climb_tag.h"
#include "physics/dynamics/site_walls.h"

namespace tera {

/// Walls in Bullet: one body that never moves, its triangles in a tree of boxes.
///
/// Model   machines' boxes against single triangles, which are thin: what gets a whole box behind a
///         wall within one step has passed it.
class StaticWalls {
 public:
  StaticWalls(const SiteWalls& walls, double friction, btMultiBodyDynamicsWorld* world);
  ~StaticWalls() { world_->removeRigidBody(body_.get()); }
  StaticWalls(const StaticWalls&) = delete;
  StaticWalls& operator=(const StaticWalls&) = delete;

 private:
  btMultiBodyDynamicsWorld* world_;
  ClimbTag tag_;
  btTriangleMesh triangles_;
  std::unique_ptr<btBvhTriangleMeshShape> shape_;
  std::unique_ptr<btRigidBody> body_;
};

}  // namespace tera
