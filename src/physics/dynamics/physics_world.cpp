#include "physics/dynamics/physics_world.h"

#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletCollision/CollisionDispatch/btDefaultCollisionConfiguration.h>
#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btBvhTriangleMeshShape.h>
#include <BulletCollision/CollisionShapes/btCompoundShape.h>
#include <BulletCollision/CollisionShapes/btTriangleMesh.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>
#include <BulletDynamics/MLCPSolvers/btDantzigSolver.h>

#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "core/check.h"
#include "physics/dynamics/bullet_types.h"
#include "physics/dynamics/climb_tag.h"
#include "physics/dynamics/machine_dynamics.h"
#include "physics/dynamics/site_walls.h"
#include "physics/dynamics/soft_row_solver.h"

namespace tera {
namespace {

/// Walls in Bullet: a static body with its triangles in a bounding-volume tree.
///
/// Model   Boxes of machines collide with single thin triangles. A box that moves entirely through
///         a wall within one step does not touch it.
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

StaticWalls::StaticWalls(const SiteWalls& walls, double friction, btMultiBodyDynamicsWorld* world)
    : world_(world) {
  for (std::size_t t = 0; t + 2 < walls.indices.size(); t += 3) {
    const std::uint32_t* i = &walls.indices[t];
    const btVector3 a = ToBullet(walls.corners_W_m[i[0]]), b = ToBullet(walls.corners_W_m[i[1]]),
                    c = ToBullet(walls.corners_W_m[i[2]]);
    // Both orientations are added, because Bullet's contact from the back of a triangle pushes a
    // box too little.
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

constexpr double kObstacleFriction = 0.8;
/// Softness (s^2/kg) of all constraints. A box on a wall has more contact points than a rigid
/// solution can distinguish; this softness makes the solution unique. A joint that holds 20 kN m
/// creeps by 1e-4 rad in an hour.
constexpr double kSoftness = 1e-12;

/// An obstacle in Bullet: a kinematic body with a prescribed motion.
struct KinematicObstacle {
  KinematicObstacle(const ObstacleBody& obstacle, btMultiBodyDynamicsWorld* world)
      : world(world), tag{.rise_m = obstacle.rise_m} {
    for (const CollisionBox& box : obstacle.collision) {
      boxes.push_back(std::make_unique<btBoxShape>(ToBullet(Vec3(0.5 * box.size_m))));
      compound.addChildShape(ToBullet(box.X_BG), boxes.back().get());
    }
    body = std::make_unique<btRigidBody>(0.0, nullptr, &compound);
    body->setCollisionFlags(btCollisionObject::CF_KINEMATIC_OBJECT);
    body->setActivationState(DISABLE_DEACTIVATION);
    body->setFriction(kObstacleFriction);
    body->setUserPointer(&tag);
    body->setWorldTransform(ToBullet(obstacle.state.X_WB));
    body->setInterpolationWorldTransform(body->getWorldTransform());
    world->addRigidBody(body.get(), btBroadphaseProxy::KinematicFilter,
                        btBroadphaseProxy::DefaultFilter);
  }
  ~KinematicObstacle() { world->removeRigidBody(body.get()); }
  KinematicObstacle(const KinematicObstacle&) = delete;
  KinematicObstacle& operator=(const KinematicObstacle&) = delete;

  btMultiBodyDynamicsWorld* world;
  ClimbTag tag;
  std::vector<std::unique_ptr<btBoxShape>> boxes;
  btCompoundShape compound;
  std::unique_ptr<btRigidBody> body;
};

/// Bullet's world with a velocity update of second order.
///
/// Model   v(n+1) = v(n) + dt a(q, v(n) + (v(n) - v(n-1)) / 2). Forces that are quadratic in
///         velocity are evaluated at the middle of the step, extrapolated from the last step.
///         Bullet evaluates them at the start of the step, which adds energy to a swinging arm
///         (about 1 % in 10 s at 500 Hz).
class MidpointWorld : public btMultiBodyDynamicsWorld {
 public:
  using btMultiBodyDynamicsWorld::btMultiBodyDynamicsWorld;

  /// Skips Bullet's prediction of link motion, which only its soft bodies use.
  void predictUnconstraintMotion(btScalar dt_s) override {
    btDiscreteDynamicsWorld::predictUnconstraintMotion(dt_s);
  }

  void solveExternalForces(btContactSolverInfo& info) override {
    to_middle_.resize(m_multiBodies.size());
    last_.resize(m_multiBodies.size());
    for (int i = 0; i < m_multiBodies.size(); ++i) {
      btMultiBody& body = *m_multiBodies[i];
      const btScalar* now = body.getVelocityVector();
      last_[i].resize(6 + body.getNumDofs());  // initially at rest
      to_middle_[i].resize(last_[i].size());
      for (std::size_t k = 0; k < last_[i].size(); ++k) {
        to_middle_[i][k] = 0.5 * (now[k] - last_[i][k]);
        last_[i][k] = now[k];
      }
      body.applyDeltaVeeMultiDof(to_middle_[i].data(), 1.0);
    }
    btMultiBodyDynamicsWorld::solveExternalForces(info);
    for (int i = 0; i < m_multiBodies.size(); ++i) {
      m_multiBodies[i]->applyDeltaVeeMultiDof(to_middle_[i].data(), -1.0);
    }
  }

 private:
  /// One entry per body: velocities at the start of the last step, and half of their change.
  std::vector<std::vector<btScalar>> last_, to_middle_;
};

/// Excludes collisions within a machine, and collisions of running gear with objects that it drives
/// over.
class OtherBodiesOnly : public btOverlapFilterCallback {
 public:
  bool needBroadphaseCollision(btBroadphaseProxy* a, btBroadphaseProxy* b) const override {
    const btMultiBody* body = BodyOf(a);
    if (DrivesOver(*ObjectOf(a), *ObjectOf(b))) return false;
    return (body == nullptr || body != BodyOf(b)) &&
           (a->m_collisionFilterGroup & b->m_collisionFilterMask) != 0 &&
           (b->m_collisionFilterGroup & a->m_collisionFilterMask) != 0;
  }

 private:
  static const btCollisionObject* ObjectOf(const btBroadphaseProxy* proxy) {
    return static_cast<const btCollisionObject*>(proxy->m_clientObject);
  }
  static const btMultiBody* BodyOf(const btBroadphaseProxy* proxy) {
    const auto* link = btMultiBodyLinkCollider::upcast(ObjectOf(proxy));
    return link ? link->m_multiBody : nullptr;
  }
};

BodyContact::Side SideOf(const btCollisionObject& object) {
  if (const auto* link = btMultiBodyLinkCollider::upcast(&object)) {
    return {BodyContact::Kind::kMachine,
            static_cast<std::size_t>(link->m_multiBody->getUserIndex()), link->m_link + 1};
  }
  if (object.getUserIndex() < 0) return {BodyContact::Kind::kWall, 0, 0};
  return {BodyContact::Kind::kObstacle, static_cast<std::size_t>(object.getUserIndex()), 0};
}

/// Pairs of bodies with an impulse between them in the last step of `dt_s`.
std::vector<BodyContact> ContactsOf(btDispatcher* dispatcher, double dt_s) {
  std::map<std::pair<BodyContact::Side, BodyContact::Side>, std::pair<BodyContact, double>> found;
  for (int k = 0; k < dispatcher->getNumManifolds(); ++k) {
    const btPersistentManifold& manifold = *dispatcher->getManifoldByIndexInternal(k);
    const BodyContact::Side a = SideOf(*manifold.getBody0()), b = SideOf(*manifold.getBody1());
    for (int p = 0; p < manifold.getNumContacts(); ++p) {
      const btManifoldPoint& point = manifold.getContactPoint(p);
      const double force_n = point.m_appliedImpulse / dt_s;
      if (force_n <= 0) continue;
      auto& [contact, sum_n] = found[{a, b}];
      contact.force_W_n += force_n * FromBullet(point.m_normalWorldOnB);
      contact.p_W_m += force_n * FromBullet(point.getPositionWorldOnB());
      sum_n += force_n;
    }
  }
  std::vector<BodyContact> contacts;
  for (const auto& [sides, summed] : found) {
    contacts.push_back(
        {sides.first, sides.second, summed.first.p_W_m / summed.second, summed.first.force_W_n});
  }
  return contacts;
}

}  // namespace

struct PhysicsWorld::Impl {
  explicit Impl(double gravity_mps2)
      : dispatcher(&collision), solver(&lcp), world(&dispatcher, &broadphase, &solver, &collision) {
    world.setGravity(btVector3(0, 0, -gravity_mps2));
    world.getDispatchInfo().m_deterministicOverlappingPairs = true;
    world.getPairCache()->setOverlapFilterCallback(&pairs);
    // Bullet solves each machine, or group of machines in contact, separately.
    world.getSolverInfo().m_minimumSolverBatchSize = 1;
    world.getSolverInfo().m_globalCfm = kSoftness;
  }

  btDefaultCollisionConfiguration collision;
  btCollisionDispatcher dispatcher;
  OtherBodiesOnly pairs;
  btDbvtBroadphase broadphase;
  btDantzigSolver lcp;
  SoftRowSolver solver;
  MidpointWorld world;
  std::vector<std::unique_ptr<KinematicObstacle>> obstacles;
  std::optional<StaticWalls> walls;
  std::vector<std::unique_ptr<MachineDynamics>> machines;
  std::vector<MachineState> states;
  std::vector<BodyContact> contacts;
};

PhysicsWorld::PhysicsWorld(const std::vector<MachinePlacement>& machines,
                           const std::vector<ObstacleBody>& obstacles, double gravity_mps2,
                           const WorldStart& start, const SiteWalls& walls)
    : impl_(std::make_unique<Impl>(gravity_mps2)) {
  for (const ObstacleBody& obstacle : obstacles) {
    impl_->obstacles.push_back(std::make_unique<KinematicObstacle>(obstacle, &impl_->world));
    impl_->obstacles.back()->body->setUserIndex(static_cast<int>(impl_->obstacles.size()) - 1);
  }
  if (!walls.empty()) impl_->walls.emplace(walls, kObstacleFriction, &impl_->world);
  const bool meets_others = machines.size() > 1 || !obstacles.empty() || !walls.empty();
  for (const MachinePlacement& placement : machines) {
    impl_->states.push_back(InitialState(placement));
    impl_->machines.push_back(
        std::make_unique<MachineDynamics>(placement, start, meets_others, &impl_->world));
    const int m = static_cast<int>(impl_->machines.size()) - 1;
    impl_->world.getMultiBody(m)->setUserIndex(m);
    impl_->machines.back()->Read(0.0, &impl_->states.back());
  }
}

PhysicsWorld::~PhysicsWorld() = default;

void PhysicsWorld::Step(const std::vector<MachineInput>& inputs,
                        const std::vector<BodyState>& obstacles, double dt_s) {
  TERA_CHECK(inputs.size() == impl_->machines.size(), inputs.size(), impl_->machines.size());
  TERA_CHECK(obstacles.size() == impl_->obstacles.size(), obstacles.size());
  TERA_CHECK(dt_s > 0, dt_s);
  for (std::size_t i = 0; i < obstacles.size(); ++i) {
    impl_->obstacles[i]->body->setWorldTransform(ToBullet(obstacles[i].X_WB));
  }
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    impl_->machines[i]->Act(inputs[i], dt_s, &impl_->states[i]);
  }
  const int no_substeps = 0;
  impl_->world.stepSimulation(dt_s, no_substeps);
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    impl_->machines[i]->Read(dt_s, &impl_->states[i]);
  }
  impl_->contacts = ContactsOf(&impl_->dispatcher, dt_s);
}

const std::vector<BodyContact>& PhysicsWorld::contacts() const { return impl_->contacts; }

const std::vector<MachineState>& PhysicsWorld::machines() const { return impl_->states; }

}  // namespace tera
