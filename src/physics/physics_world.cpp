#include "physics/physics_world.h"

#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletCollision/CollisionDispatch/btDefaultCollisionConfiguration.h>
#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btCompoundShape.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>
#include <BulletDynamics/Featherstone/btMultiBodyMLCPConstraintSolver.h>
#include <BulletDynamics/MLCPSolvers/btDantzigSolver.h>

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "physics/articulated_body.h"
#include "physics/bullet_types.h"
#include "physics/hydraulics.h"
#include "physics/payload.h"
#include "physics/slots/actuation.h"
#include "physics/track_drive.h"

namespace tera {
namespace {

constexpr double kObstacleFriction = 0.8;
/// Softness (s^2/kg) of all constraints. A box on a wall has more contact points than a rigid
/// solution can tell apart; this much makes it unique, and lets a joint that holds 20 kN m creep by
/// 1e-4 rad in an hour.
constexpr double kSoftness = 1e-12;

/// An obstacle in Bullet: a body that moves as it is told.
struct KinematicObstacle {
  KinematicObstacle(const ObstacleBody& obstacle, btMultiBodyDynamicsWorld* world) : world(world) {
    for (const CollisionBox& box : obstacle.collision) {
      boxes.push_back(std::make_unique<btBoxShape>(ToBullet(Vec3(0.5 * box.size_m))));
      compound.addChildShape(ToBullet(box.X_BG), boxes.back().get());
    }
    body = std::make_unique<btRigidBody>(0.0, nullptr, &compound);
    body->setCollisionFlags(btCollisionObject::CF_KINEMATIC_OBJECT);
    body->setActivationState(DISABLE_DEACTIVATION);
    body->setFriction(kObstacleFriction);
    body->setWorldTransform(ToBullet(obstacle.state.X_WB));
    body->setInterpolationWorldTransform(body->getWorldTransform());
    world->addRigidBody(body.get(), btBroadphaseProxy::KinematicFilter,
                        btBroadphaseProxy::DefaultFilter);
  }
  ~KinematicObstacle() { world->removeRigidBody(body.get()); }
  KinematicObstacle(const KinematicObstacle&) = delete;
  KinematicObstacle& operator=(const KinematicObstacle&) = delete;

  btMultiBodyDynamicsWorld* world;
  std::vector<std::unique_ptr<btBoxShape>> boxes;
  btCompoundShape compound;
  std::unique_ptr<btRigidBody> body;
};

/// Bullet's world with a velocity update of second order.
///
/// Model   v(n+1) = v(n) + dt a(q, v(n) + (v(n) - v(n-1)) / 2): forces that grow with the square of
///         velocity are taken in the middle of the step, extrapolated from the last one. Bullet
///         takes them at its start, which feeds energy into a swinging arm (about 1 % in 10 s at
///         500 Hz).
class MidpointWorld : public btMultiBodyDynamicsWorld {
 public:
  using btMultiBodyDynamicsWorld::btMultiBodyDynamicsWorld;

  /// Bullet would also predict where links go, which only its soft bodies use.
  void predictUnconstraintMotion(btScalar dt_s) override {
    btDiscreteDynamicsWorld::predictUnconstraintMotion(dt_s);
  }

  void solveExternalForces(btContactSolverInfo& info) override {
    to_middle_.resize(m_multiBodies.size());
    last_.resize(m_multiBodies.size());
    for (int i = 0; i < m_multiBodies.size(); ++i) {
      btMultiBody& body = *m_multiBodies[i];
      const btScalar* now = body.getVelocityVector();
      last_[i].resize(6 + body.getNumDofs());  // from rest
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
  /// One for each body: velocities at the start of the last step, and half of what they changed.
  std::vector<std::vector<btScalar>> last_, to_middle_;
};

/// Parts of one machine are no pairs for collision.
class OtherBodiesOnly : public btOverlapFilterCallback {
 public:
  bool needBroadphaseCollision(btBroadphaseProxy* a, btBroadphaseProxy* b) const override {
    const btMultiBody* body = BodyOf(a);
    return (body == nullptr || body != BodyOf(b)) &&
           (a->m_collisionFilterGroup & b->m_collisionFilterMask) != 0 &&
           (b->m_collisionFilterGroup & a->m_collisionFilterMask) != 0;
  }

 private:
  static const btMultiBody* BodyOf(const btBroadphaseProxy* proxy) {
    const auto* object = static_cast<const btCollisionObject*>(proxy->m_clientObject);
    const auto* link = btMultiBodyLinkCollider::upcast(object);
    return link ? link->m_multiBody : nullptr;
  }
};

/// Joint angles may be given this far outside their limits, for rounding.
constexpr double kLimitTolerance_rad = 1e-6;

MachineState InitialState(const MachinePlacement& placement) {
  const MachineModel& model = placement.model;
  TERA_CHECK(placement.q_rad.size() == model.joints.size(), placement.name);
  for (std::size_t k = 0; k < model.joints.size(); ++k) {
    const Joint& joint = model.joints[k];
    if (joint.type != JointType::kRevolute && joint.type != JointType::kPrismatic) continue;
    TERA_CHECK(placement.q_rad[k] >= joint.lower_rad - kLimitTolerance_rad &&
                   placement.q_rad[k] <= joint.upper_rad + kLimitTolerance_rad,
               placement.name, joint.name, placement.q_rad[k]);
  }
  const std::size_t gears = model.ground_tools.gears.size();
  MachineState state;
  state.links.resize(model.links.size());
  state.q_rad = placement.q_rad;
  state.qd_radps.assign(model.joints.size(), 0.0);
  state.effort_nm.assign(model.joints.size(), 0.0);
  state.friction_nm.assign(model.joints.size(), 0.0);
  state.gear_angle_rad.assign(gears, 0.0);
  state.gear_rate_radps.assign(gears, 0.0);
  state.gear_torque_nm.assign(gears, 0.0);
  state.gear_friction_nm.assign(gears, 0.0);
  state.gear_sinkage_m.assign(gears, 0.0);
  state.gear_slip.assign(gears, 0.0);
  state.levers.assign(model.levers.size(), 0.0);
  state.shovel_load.resize(model.ground_tools.shovels.size());
  return state;
}

MachineModel WithPayloads(MachineModel model) {
  AddPayloads(&model);
  return model;
}

/// Torques of a running gear's motor and of its friction over a step.
struct GearTorques {
  double motor_nm = 0, friction_nm = 0;
};

/// Motor and friction of one inertia.
///
/// Model   The rate at the end of the step, v = v0 + (motor + friction - load) dt / I, is the
///         target as far as the motor's torque allows, and friction opposes v, or holds v = 0, as
///         far as its own allows. The sum of both falls with v in two steps, at 0 and at the
///         target, so that there is one solution.
GearTorques Drive(const GearDrive& drive, const AxisDrive& target, double rate_radps,
                  double load_nm, double dt_s) {
  const double inertia_kgm2 = drive.inertia_kgm2, most_nm = drive.max_torque_nm;
  const auto motor_nm = [&](double friction_nm) {
    const double needed_nm =
        inertia_kgm2 * (target.rate_radps - rate_radps) / dt_s + (load_nm - friction_nm);
    return std::clamp(needed_nm, -most_nm, most_nm);
  };
  if (!target.friction.any()) return {motor_nm(0), 0};
  const auto end_radps = [&](double friction_nm) {
    return rate_radps + (motor_nm(friction_nm) - (load_nm - friction_nm)) * dt_s / inertia_kgm2;
  };
  const double up = target.friction.against_negative_nm;
  const double down = -target.friction.against_positive_nm;
  if (end_radps(up) < 0) return {motor_nm(up), up};
  if (end_radps(down) > 0) return {motor_nm(down), down};
  const double held_nm = load_nm - inertia_kgm2 * rate_radps / dt_s;
  const double motor =
      target.rate_radps == 0 ? motor_nm(0) : std::copysign(most_nm, target.rate_radps);
  return {motor, held_nm - motor};
}

/// Torque of a motor whose gear turns as commanded whatever its load.
constexpr double kUnlimited_nm = 1e9;

/// A machine's levers, drives and running gear around its articulated body.
struct MachineDynamics {
  MachineDynamics(const MachinePlacement& placement, const WorldStart& start, bool meets_others,
                  btMultiBodyDynamicsWorld* world)
      : model(WithPayloads(placement.model)),
        tracks(model),
        body(model, placement.X_WB, placement.q_rad, meets_others, world),
        hydraulics(model, placement.q_rad),
        actuation(model, {placement.name, start.seed, start.step}) {
    if (model.ground == GroundModel::kTerramechanics) return;
    body.AddBaseDrive(tracks.contact_B_m());
    for (GearDrive& drive : model.gear_drives) drive.max_torque_nm = kUnlimited_nm;
  }

  /// The lever of each axis, joints first, then gears.
  void Command(const std::vector<double>& levers, MachineState* state);
  /// The chain from levers to drives, from where the axes are.
  void Actuate(const SoilReaction& soil, double dt_s, const MachineState& state);
  void DriveJoints();
  /// What the ground does to the gears when the base is driven instead of sheared along.
  SoilReaction OnDrivenBase(const SoilReaction& soil, double dt_s, const MachineState& state) const;
  void TurnGears(const SoilReaction& soil, double dt_s, MachineState* state);
  void Act(const MachineInput& input, double dt_s, MachineState* state);
  /// What came of a step.
  void Read(double dt_s, MachineState* state);

  double GearLoad_nm(const SoilReaction& soil, std::size_t gear) const {
    return gear < soil.gear_traction_n.size()
               ? soil.gear_traction_n[gear] * model.ground_tools.gears[gear].drive_radius_m
               : 0.0;
  }

  MachineModel model;
  TrackDrive tracks;
  ArticulatedBody body;
  Hydraulics hydraulics;
  Actuation actuation;
  std::vector<double> axis_lever;
  std::vector<AxisMotion> axis_motion;
  std::vector<JointTarget> joint_target;
};

void MachineDynamics::Command(const std::vector<double>& levers, MachineState* state) {
  TERA_CHECK(levers.size() == model.levers.size(), levers.size(), model.levers.size());
  axis_lever.assign(model.joints.size() + model.gear_drives.size(), 0.0);
  for (std::size_t i = 0; i < levers.size(); ++i) {
    const Lever& lever = model.levers[i];
    const double u = std::clamp(levers[i], -1.0, 1.0);
    state->levers[i] = u;
    if (lever.joint >= 0) axis_lever[lever.joint] = u;
    if (lever.gear >= 0) axis_lever[model.joints.size() + lever.gear] = u;
  }
}

void MachineDynamics::Actuate(const SoilReaction& soil, double dt_s, const MachineState& state) {
  axis_motion.resize(axis_lever.size());
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    axis_motion[j] = {state.q_rad[j], state.qd_radps[j], state.effort_nm[j] + state.friction_nm[j]};
  }
  for (std::size_t g = 0; g < model.gear_drives.size(); ++g) {
    axis_motion[model.joints.size() + g] = {state.gear_angle_rad[g], state.gear_rate_radps[g],
                                            GearLoad_nm(soil, g)};
  }
  actuation.Step(axis_lever, axis_motion, dt_s);
}

void MachineDynamics::DriveJoints() {
  joint_target.resize(model.joints.size());
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    const EffortLimits& limits = hydraulics.limits()[j];
    const AxisDrive& drive = actuation.drives()[j];
    joint_target[j] = {drive.rate_radps, limits.positive_nm, limits.negative_nm, drive.friction};
  }
  body.DriveJoints(joint_target);
}

void MachineDynamics::TurnGears(const SoilReaction& soil, double dt_s, MachineState* state) {
  for (std::size_t g = 0; g < model.gear_drives.size(); ++g) {
    const GearDrive& drive = model.gear_drives[g];
    double& rate = state->gear_rate_radps[g];
    const double load_nm = GearLoad_nm(soil, g);
    AxisDrive target = actuation.drives()[model.joints.size() + g];
    target.rate_radps = tracks.GearRate(g, target.rate_radps);
    const GearTorques torques = Drive(drive, target, rate, load_nm, dt_s);
    rate += (torques.motor_nm - (load_nm - torques.friction_nm)) * dt_s / drive.inertia_kgm2;
    state->gear_angle_rad[g] += rate * dt_s;
    state->gear_torque_nm[g] = torques.motor_nm;
    state->gear_friction_nm[g] = torques.friction_nm;
  }
}

SoilReaction MachineDynamics::OnDrivenBase(const SoilReaction& soil, double dt_s,
                                           const MachineState& state) const {
  SoilReaction reaction = soil;
  reaction.gear_traction_n = tracks.Traction_n(body.BaseDriveEffort(dt_s), state);
  return reaction;
}

void MachineDynamics::Act(const MachineInput& input, double dt_s, MachineState* state) {
  Command(input.levers, state);
  if (model.ground == GroundModel::kTerramechanics) {
    Actuate(input.soil, dt_s, *state);
    TurnGears(input.soil, dt_s, state);
  } else {
    const SoilReaction soil = OnDrivenBase(input.soil, dt_s, *state);
    Actuate(soil, dt_s, *state);
    TurnGears(soil, dt_s, state);
    const TrackDrive::Target target = tracks.Follow(*state, input.soil);
    body.DriveBase(target.twist, target.most);
  }
  DriveJoints();
  body.SetLoads(input.soil.shovel_load);
  body.ApplyWrenches(input.soil.link_wrench, state->links);
  if (!input.soil.shovel_load.empty()) state->shovel_load = input.soil.shovel_load;
  if (!input.soil.gear_sinkage_m.empty()) state->gear_sinkage_m = input.soil.gear_sinkage_m;
  if (!input.soil.gear_slip.empty()) state->gear_slip = input.soil.gear_slip;
}

void MachineDynamics::Read(double dt_s, MachineState* state) {
  body.ReadState(dt_s, state);
  hydraulics.Update(state->q_rad);
  hydraulics.Measure(state);
}

}  // namespace

struct PhysicsWorld::Impl {
  explicit Impl(double gravity_mps2)
      : dispatcher(&collision), solver(&lcp), world(&dispatcher, &broadphase, &solver, &collision) {
    world.setGravity(btVector3(0, 0, -gravity_mps2));
    world.getDispatchInfo().m_deterministicOverlappingPairs = true;
    world.getPairCache()->setOverlapFilterCallback(&pairs);
    // Each machine (or group of machines in contact) is solved for itself.
    world.getSolverInfo().m_minimumSolverBatchSize = 1;
    world.getSolverInfo().m_globalCfm = kSoftness;
  }

  btDefaultCollisionConfiguration collision;
  btCollisionDispatcher dispatcher;
  OtherBodiesOnly pairs;
  btDbvtBroadphase broadphase;
  btDantzigSolver lcp;
  btMultiBodyMLCPConstraintSolver solver;
  MidpointWorld world;
  std::vector<std::unique_ptr<KinematicObstacle>> obstacles;
  std::vector<std::unique_ptr<MachineDynamics>> machines;
  std::vector<MachineState> states;
};

PhysicsWorld::PhysicsWorld(const std::vector<MachinePlacement>& machines,
                           const std::vector<ObstacleBody>& obstacles, double gravity_mps2,
                           const WorldStart& start)
    : impl_(std::make_unique<Impl>(gravity_mps2)) {
  for (const ObstacleBody& obstacle : obstacles) {
    impl_->obstacles.push_back(std::make_unique<KinematicObstacle>(obstacle, &impl_->world));
  }
  const bool meets_others = machines.size() > 1 || !obstacles.empty();
  for (const MachinePlacement& placement : machines) {
    impl_->states.push_back(InitialState(placement));
    impl_->machines.push_back(
        std::make_unique<MachineDynamics>(placement, start, meets_others, &impl_->world));
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
}

const std::vector<MachineState>& PhysicsWorld::machines() const { return impl_->states; }

}  // namespace tera
