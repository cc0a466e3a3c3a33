#pragma once

#include <memory>

#include "core/motion.h"
#include "physics/traction/track_kinematics.h"

class btMultiBody;
class btMultiBodyDynamicsWorld;

namespace tera {

/// Drives the root link of a machine over the ground by three velocity constraints.
///
/// Frames  B root link.
/// Model   In each step the centre of the tracks' contact takes the commanded twist, within the
///         force limits. The twist is along B's x and y and about its z axis. The other three
///         directions are free, so that the machine can sink, pitch, roll and tip over. The
///         constraints are solved together with all joints and contacts of the machine.
/// Omits   The common friction limit of the three forces: each force has its own limit.
class BaseDrive {
 public:
  /// Drives the root of `body`; `body` and `world` must outlive the drive. `contact_P_m` is the
  /// driven point and `R_PB` its directions, in Bullet's frame P of the root.
  BaseDrive(btMultiBody* body, const Vec3& contact_P_m, const Mat3& R_PB,
            btMultiBodyDynamicsWorld* world);
  ~BaseDrive();
  BaseDrive(BaseDrive&&) noexcept;

  void SetTarget(const PlanarTwist& twist, const BaseEffort& most);
  /// Forces of the drive on the machine, averaged over the last step of `dt_s`.
  BaseEffort Effort(double dt_s) const;

 private:
  class Constraint;
  std::unique_ptr<Constraint> constraint_;
  btMultiBodyDynamicsWorld* world_;
};

}  // namespace tera
