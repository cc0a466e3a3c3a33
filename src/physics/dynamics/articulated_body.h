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

/// Links and joints of one machine in Bullet.
///
/// Frames  Bullet's frame P of a link lies at the centre of mass, along the principal axes of
///         inertia; X_BP converts it. The interface of this class uses B.
/// Model   Featherstone's articulated body. Each shovel that carries soil has an extra link fixed
///         to it, with the mass of the soil and the inertia of a cube of the soil's volume.
class ArticulatedBody {
 public:
  /// If `meets_others` is false, the machine has no collision shapes.
  ArticulatedBody(const MachineModel& model, const Pose& X_WB, const std::vector<double>& q_rad,
                  bool meets_others, btMultiBodyDynamicsWorld* world);
  ~ArticulatedBody();
  ArticulatedBody(ArticulatedBody&&) noexcept;

  /// Enables DriveBase, which drives the root at the point `contact_B_m`.
  void AddBaseDrive(const Vec3& contact_B_m);
  void DriveBase(const PlanarTwist& twist, const BaseEffort& most);
  BaseEffort BaseDriveEffort(double dt_s) const;

  /// Inputs of the next step: loads and wrenches from the soil, and targets of the joints.
  void SetLoads(const std::vector<SoilReaction::Load>& shovel_load);
  void ApplyWrenches(const std::vector<Wrench>& link_wrench, const std::vector<BodyState>& links);
  void DriveJoints(const std::vector<JointTarget>& targets);

  /// Reads joints and links after a step of `dt_s`. Accelerations are the change of velocity
  /// relative to the previous contents of `state`, over `dt_s`.
  void ReadState(double dt_s, MachineState* state) const;

 private:
  struct Bullet;
  const MachineModel& model_;
  std::unique_ptr<Bullet> bullet_;
};

}  // namespace tera
