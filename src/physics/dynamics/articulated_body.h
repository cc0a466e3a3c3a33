#pragma once

#include <memory>
#include <vector>

#include "core/types/ground_tools.h"
#include "physics/description/machine.h"
#include "physics/dynamics/base_drive.h"
#include "physics/dynamics/joint_drive.h"

class btMultiBody;
class btMultiBodyDynamicsWorld;

namespace tera {

/// One machine's links and joints in Bullet.
///
/// Frames  Bullet's links have their frame P at the centre of mass along the principal axes of
///         inertia; X_BP of each link translates. Everything outside this class is in B.
/// Model   Featherstone's articulated body. Each shovel that carries has a link fixed to its tool
///         whose mass is the soil's, a cube of the soil's volume.
class ArticulatedBody {
 public:
  /// A machine that meets no others, nor obstacles, goes without its collision shapes.
  ArticulatedBody(const MachineModel& model, const Pose& X_WB, const std::vector<double>& q_rad,
                  bool meets_others, btMultiBodyDynamicsWorld* world);
  ~ArticulatedBody();
  ArticulatedBody(ArticulatedBody&&) noexcept;

  /// Lets DriveBase move the root by its point `contact_B_m`.
  void AddBaseDrive(const Vec3& contact_B_m);
  void DriveBase(const PlanarTwist& twist, const BaseEffort& most);
  BaseEffort BaseDriveEffort(double dt_s) const;

  /// For the next step: what the soil does, and what drives each joint.
  void SetLoads(const std::vector<SoilReaction::Load>& shovel_load);
  void ApplyWrenches(const std::vector<Wrench>& link_wrench, const std::vector<BodyState>& links);
  void DriveJoints(const std::vector<JointTarget>& targets);

  /// Joints and links after a step of `dt_s`; accelerations from the change of velocity against
  /// what `state` held before.
  void ReadState(double dt_s, MachineState* state) const;

 private:
  struct Bullet;
  const MachineModel& model_;
  std::unique_ptr<Bullet> bullet_;
};

}  // namespace tera
