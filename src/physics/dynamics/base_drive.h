#pragma once

#include <memory>

#include "core/motion.h"
#include "physics/traction/track_kinematics.h"

class btMultiBody;
class btMultiBodyDynamicsWorld;

namespace tera {

/// Drives a machine's root link over the ground by three velocity constraints.
///
/// Frames  B root link.
/// Model   In each step the point amid the tracks' contact takes the twist that is asked for along
///         B's x and y and about its z axis, as far as the largest forces allow. The other three
///         directions are free: the machine sinks, pitches, rolls and tips over. Solved together
///         with all joints and contacts of the machine.
/// Omits   that the three forces share one friction: each has its limit for itself.
class BaseDrive {
 public:
  /// For the root of `body`, which with `world` must outlive the drive. `contact_P_m`: the point
  /// that is driven, `R_PB` the directions, in Bullet's frame P of the root.
  BaseDrive(btMultiBody* body, const Vec3& contact_P_m, const Mat3& R_PB,
            btMultiBodyDynamicsWorld* world);
  ~BaseDrive();
  BaseDrive(BaseDrive&&) noexcept;

  void SetTarget(const PlanarTwist& twist, const BaseEffort& most);
  /// Forces of the drive on the machine over the last step of `dt_s`.
  BaseEffort Effort(double dt_s) const;

 private:
  class Constraint;
  std::unique_ptr<Constraint> constraint_;
  btMultiBodyDynamicsWorld* world_;
};

}  // namespace tera
