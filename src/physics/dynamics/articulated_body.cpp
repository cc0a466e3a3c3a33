#include "physics/dynamics/articulated_body.h"

#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btCompoundShape.h>
#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <optional>

#include "core/check.h"
#include "core/types/rigid_obstacle.h"
#include "physics/dynamics/bullet_types.h"
#include "physics/dynamics/climb_tag.h"
#include "physics/dynamics/joint_tie.h"
#include "physics/dynamics/link_motion.h"

namespace tera {
namespace {

/// Replaces Bullet's default limits on velocities and impulses. No value approaches this bound.
constexpr double kUnlimited = 1e12;
/// Steel on rock, dry.
constexpr double kSurfaceFriction = 0.5;

/// Products of inertia below this share of the largest moment are rounding errors. The axes of the
/// link then serve as principal axes.
constexpr double kDiagonal = 1e-12;

struct PrincipalAxes {
  Pose X_BP = Pose::Identity();
  Vec3 moments_kgm2 = Vec3::Zero();
};

PrincipalAxes PrincipalAxesOf(const Link& link) {
  PrincipalAxes axes;
  axes.X_BP.translation() = link.com_B_m;
  axes.moments_kgm2 = link.inertia_B_kgm2.diagonal();
  if (link.inertia_B_kgm2.isDiagonal(kDiagonal)) return axes;
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(link.inertia_B_kgm2);
  Mat3 R = solver.eigenvectors();
  if (R.determinant() < 0) R.col(2) *= -1;
  axes.X_BP.linear() = R;
  axes.moments_kgm2 = solver.eigenvalues();
  return axes;
}

/// Boxes of a link in its frame P, and their collider.
struct LinkShape {
  std::vector<std::unique_ptr<btBoxShape>> boxes;
  std::unique_ptr<btCompoundShape> compound;
  std::unique_ptr<btMultiBodyLinkCollider> collider;
  std::unique_ptr<ClimbTag> tag;
};

LinkShape MakeShape(const Link& link, const Pose& X_BP, btMultiBody* body, int bullet_link) {
  LinkShape shape;
  shape.compound = std::make_unique<btCompoundShape>();
  // meshes must already be converted to boxes
  TERA_CHECK(link.collision_meshes.empty(), link.name);
  for (const CollisionBox& box : link.collision) {
    shape.boxes.push_back(std::make_unique<btBoxShape>(ToBullet(Vec3(0.5 * box.size_m))));
    shape.compound->addChildShape(ToBullet(Pose(X_BP.inverse() * box.X_BG)),
                                  shape.boxes.back().get());
  }
  shape.collider = std::make_unique<btMultiBodyLinkCollider>(body, bullet_link);
  shape.collider->setCollisionShape(shape.compound.get());
  shape.collider->setActivationState(DISABLE_DEACTIVATION);
  shape.collider->setFriction(kSurfaceFriction);
  return shape;
}

}  // namespace

struct ArticulatedBody::Bullet {
  btMultiBodyDynamicsWorld* world = nullptr;
  std::unique_ptr<btMultiBody> body;
  std::vector<PrincipalAxes> axes;  // one per link
  std::vector<LinkShape> shapes;
  std::vector<std::optional<JointDrive>> drives;  // one per joint; empty for fixed joints
  std::vector<JointTie> ties;                     // for joints that follow another joint
  std::optional<BaseDrive> base_drive;
  std::vector<int> load_link;  // one per shovel; -1 if it cannot carry

  ~Bullet() {
    if (!world) return;
    drives.clear();
    ties.clear();
    base_drive.reset();
    for (const LinkShape& shape : shapes) world->removeCollisionObject(shape.collider.get());
    world->removeMultiBody(body.get());
  }

  void AddLinks(const MachineModel& model);
  void AddLoadLinks(const MachineModel& model);
  void AddShapes(const MachineModel& model, bool meets_others);
  void AddDrives(const MachineModel& model);
};

void ArticulatedBody::Bullet::AddLinks(const MachineModel& model) {
  for (std::size_t k = 0; k < model.joints.size(); ++k) {
    const Joint& joint = model.joints[k];
    TERA_CHECK(joint.child == static_cast<int>(k) + 1 && joint.parent <= static_cast<int>(k),
               joint.name, joint.parent, joint.child);
    const Pose& X_BP_parent = axes[joint.parent].X_BP;
    const Pose& X_BP_child = axes[joint.child].X_BP;
    const Mat3 R_parent_child =
        X_BP_parent.linear().transpose() * joint.X_PJ.linear() * X_BP_child.linear();
    const btQuaternion parent_to_child = ToBullet(Mat3(R_parent_child.transpose()));
    const btVector3 to_pivot = ToBullet(Vec3(X_BP_parent.inverse() * joint.X_PJ.translation()));
    const btVector3 from_pivot =
        ToBullet(Vec3(X_BP_child.linear().transpose() * X_BP_child.translation()));
    const btVector3 axis = ToBullet(Vec3(X_BP_child.linear().transpose() * joint.axis_J));
    const double mass_kg = model.links[joint.child].mass_kg;
    const btVector3 moments = ToBullet(axes[joint.child].moments_kgm2);
    const int link = static_cast<int>(k), parent = joint.parent - 1;
    switch (joint.type) {
      case JointType::kFixed:
        body->setupFixed(link, mass_kg, moments, parent, parent_to_child, to_pivot, from_pivot);
        break;
      case JointType::kRevolute:
      case JointType::kContinuous:
        body->setupRevolute(link, mass_kg, moments, parent, parent_to_child, axis, to_pivot,
                            from_pivot, true);
        break;
      case JointType::kPrismatic:
        body->setupPrismatic(link, mass_kg, moments, parent, parent_to_child, axis, to_pivot,
                             from_pivot, true);
        break;
    }
  }
}

void ArticulatedBody::Bullet::AddLoadLinks(const MachineModel& model) {
  int link = static_cast<int>(model.joints.size());
  for (const Shovel& shovel : model.ground_tools.shovels) {
    load_link.push_back(shovel.capacity_m3 > 0 ? link++ : -1);
    if (load_link.back() < 0) continue;
    const btVector3 zero(0, 0, 0);
    body->setupFixed(load_link.back(), 0, zero, shovel.link - 1, btQuaternion::getIdentity(), zero,
                     zero);
  }
}

void ArticulatedBody::Bullet::AddShapes(const MachineModel& model, bool meets_others) {
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    // The base always has a collider: Bullet uses it to find a machine's group of constraints.
    const int link = static_cast<int>(i) - 1;
    if (link >= 0 && (!meets_others || model.links[i].collision.empty())) continue;
    shapes.push_back(MakeShape(model.links[i], axes[i].X_BP, body.get(), link));
    btMultiBodyLinkCollider* collider = shapes.back().collider.get();
    shapes.back().tag = std::make_unique<ClimbTag>();
    shapes.back().tag->climb_m = ClimbHeight_m(model.ground_tools.gears, static_cast<int>(i));
    collider->setUserPointer(shapes.back().tag.get());
    if (link < 0) {
      body->setBaseCollider(collider);
    } else {
      body->getLink(link).m_collider = collider;
    }
    world->addCollisionObject(collider, btBroadphaseProxy::DefaultFilter,
                              btBroadphaseProxy::AllFilter);
  }
}

void ArticulatedBody::Bullet::AddDrives(const MachineModel& model) {
  for (std::size_t k = 0; k < model.joints.size(); ++k) {
    const Joint& joint = model.joints[k];
    drives.emplace_back();
    if (joint.type == JointType::kFixed) continue;
    drives.back().emplace(body.get(), static_cast<int>(k), world);
    if (joint.following) {
      ties.emplace_back(body.get(), static_cast<int>(k), *joint.following, world);
      continue;  // the leading joint has the stops
    }
    if (joint.type == JointType::kContinuous) continue;
    drives.back()->SetStops(joint.lower_rad, joint.upper_rad);
  }
}

ArticulatedBody::ArticulatedBody(const MachineModel& model, const Pose& X_WB,
                                 const std::vector<double>& q_rad, bool meets_others,
                                 btMultiBodyDynamicsWorld* world)
    : model_(model), bullet_(std::make_unique<Bullet>()) {
  TERA_CHECK(q_rad.size() == model.joints.size(), q_rad.size(), model.joints.size());
  for (const Link& link : model.links) bullet_->axes.push_back(PrincipalAxesOf(link));
  int count = static_cast<int>(model.joints.size());
  for (const Shovel& shovel : model.ground_tools.shovels) count += shovel.capacity_m3 > 0;
  const bool can_sleep = false;
  bullet_->body = std::make_unique<btMultiBody>(count, model.links[0].mass_kg,
                                                ToBullet(bullet_->axes[0].moments_kgm2),
                                                model.fixed_base, can_sleep);
  btMultiBody& body = *bullet_->body;
  bullet_->AddLinks(model);
  bullet_->AddLoadLinks(model);
  body.finalizeMultiDof();
  body.setLinearDamping(0);
  body.setAngularDamping(0);
  body.setUseGyroTerm(true);
  body.setMaxCoordinateVelocity(kUnlimited);
  body.setMaxAppliedImpulse(kUnlimited);
  body.setHasSelfCollision(false);
  body.setBaseWorldTransform(ToBullet(Pose(X_WB * bullet_->axes[0].X_BP)));
  for (std::size_t k = 0; k < q_rad.size(); ++k) {
    if (model.joints[k].type != JointType::kFixed) body.setJointPos(static_cast<int>(k), q_rad[k]);
  }
  bullet_->world = world;
  bullet_->AddShapes(model, meets_others);
  world->addMultiBody(&body);
  btAlignedObjectArray<btQuaternion> rotations;
  btAlignedObjectArray<btVector3> origins;
  body.forwardKinematics(rotations, origins);
  body.updateCollisionObjectWorldTransforms(rotations, origins);
  bullet_->AddDrives(model);
}

ArticulatedBody::~ArticulatedBody() = default;
ArticulatedBody::ArticulatedBody(ArticulatedBody&&) noexcept = default;

void ArticulatedBody::AddBaseDrive(const Vec3& contact_B_m) {
  const Pose X_PB = bullet_->axes[0].X_BP.inverse();
  bullet_->base_drive.emplace(bullet_->body.get(), X_PB * contact_B_m, X_PB.linear(),
                              bullet_->world);
}

void ArticulatedBody::DriveBase(const PlanarTwist& twist, const BaseEffort& most) {
  bullet_->base_drive->SetTarget(twist, most);
}

BaseEffort ArticulatedBody::BaseDriveEffort(double dt_s) const {
  return bullet_->base_drive->Effort(dt_s);
}

void ArticulatedBody::SetLoads(const std::vector<SoilReaction::Load>& shovel_load) {
  for (std::size_t s = 0; s < shovel_load.size() && s < bullet_->load_link.size(); ++s) {
    if (bullet_->load_link[s] < 0) continue;
    const SoilReaction::Load& load = shovel_load[s];
    const Pose& X_BP = bullet_->axes[model_.ground_tools.shovels[s].link].X_BP;
    btMultibodyLink& link = bullet_->body->getLink(bullet_->load_link[s]);
    // A cube of side a has the moment m a^2 / 6 about its centre.
    const double moment_kgm2 = load.mass_kg * std::pow(load.volume_m3, 2.0 / 3.0) / 6.0;
    link.m_mass = load.mass_kg;
    link.m_inertiaLocal = ToBullet(Vec3(Vec3::Constant(moment_kgm2)));
    link.m_eVector = ToBullet(Vec3(X_BP.inverse() * load.com_B_m));
    link.updateCacheMultiDof();
  }
}

void ArticulatedBody::ApplyWrenches(const std::vector<Wrench>& link_wrench,
                                    const std::vector<BodyState>& links) {
  btMultiBody& body = *bullet_->body;
  for (std::size_t i = 0; i < link_wrench.size() && i < links.size(); ++i) {
    const Wrench& wrench = link_wrench[i];
    if (wrench.force_W_n.isZero(0) && wrench.torque_W_nm.isZero(0)) continue;
    // from B's origin to the centre of mass
    const Vec3 r_W = links[i].X_WB.linear() * bullet_->axes[i].X_BP.translation();
    const btVector3 force = ToBullet(wrench.force_W_n);
    const btVector3 torque = ToBullet(Vec3(wrench.torque_W_nm - r_W.cross(wrench.force_W_n)));
    if (i == 0) {
      body.addBaseForce(force);
      body.addBaseTorque(torque);
    } else {
      body.addLinkForce(static_cast<int>(i) - 1, force);
      body.addLinkTorque(static_cast<int>(i) - 1, torque);
    }
  }
}

void ArticulatedBody::DriveJoints(const std::vector<JointTarget>& targets) {
  for (std::size_t k = 0; k < targets.size(); ++k) {
    if (!bullet_->drives[k]) continue;
    bullet_->drives[k]->SetTarget(targets[k]);
    if (targets[k].offset_nm != 0) {
      bullet_->body->addJointTorque(static_cast<int>(k), -targets[k].offset_nm);
    }
  }
}

void ArticulatedBody::ReadState(double dt_s, MachineState* state) const {
  const btMultiBody& body = *bullet_->body;
  for (std::size_t k = 0; k < model_.joints.size(); ++k) {
    if (!bullet_->drives[k]) continue;
    state->q_rad[k] = body.getJointPos(static_cast<int>(k));
    state->qd_radps[k] = body.getJointVel(static_cast<int>(k));
    state->effort_nm[k] = dt_s > 0 ? bullet_->drives[k]->Effort(dt_s) : 0.0;
    state->friction_nm[k] = dt_s > 0 ? bullet_->drives[k]->Friction(dt_s) : 0.0;
  }
  const Pose X_WP = MakePose(FromBullet(body.getBasePos()),
                             Mat3(FromBullet(body.getWorldToBaseRot()).transpose()));
  RootMotion root{.X_WB = X_WP * bullet_->axes[0].X_BP.inverse()};
  root.w_WB_radps = FromBullet(body.getBaseOmega());
  const Vec3 r_W = root.X_WB.translation() - X_WP.translation();
  root.v_WB_mps = FromBullet(body.getBaseVel()) + root.w_WB_radps.cross(r_W);
  MoveLinks(model_, root, state->q_rad, state->qd_radps, dt_s, &state->links);
}

}  // namespace tera
