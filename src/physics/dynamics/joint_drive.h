#pragma once

#include <memory>

#include "physics/actuation/load_friction.h"

class btMultiBody;
class btMultiBodyDynamicsWorld;

namespace tera {

/// Target of a joint during a step. Efforts are magnitudes in newton metres, or newtons for
/// prismatic joints. A joint without effort swings freely.
struct JointTarget {
  double rate_radps = 0;
  /// limits of the motor for positive and negative effort
  double max_positive_nm = 0, max_negative_nm = 0;
  AxisFriction friction;
  double offset_nm = 0;  ///< pushes the joint in the negative direction, independently of the motor
};

/// Motor, friction and end stops of a joint with one degree of freedom.
///
/// Model   The motor reaches its target rate within the step, within its effort limit. Near a stop,
///         the target is reduced so that the joint comes to rest at the stop. Dry friction opposes
///         motion at the end of the step or holds the joint at rest, within its bounds. Viscous
///         friction is its coefficient times the rate at the end of the step. A stop is inelastic
///         and has unlimited effort. All rows are solved together with all other joints and
///         contacts of the machine. If motor and friction both hold a joint, the motor takes the
///         load up to its limit.
/// Omits   Compliance.
class JointDrive {
 public:
  /// Drives link `bullet_link` of `body`; `body` and `world` must outlive the drive.
  JointDrive(btMultiBody* body, int bullet_link, btMultiBodyDynamicsWorld* world);
  ~JointDrive();
  JointDrive(JointDrive&&) noexcept;

  void SetStops(double lower, double upper);
  void SetTarget(const JointTarget& target);
  /// Mean effort of motor and stops together over the last step of `dt_s`.
  double Effort(double dt_s) const;
  /// Mean effort of friction over the last step of `dt_s`.
  double Friction(double dt_s) const;

 private:
  class Constraint;
  std::unique_ptr<Constraint> constraint_;
  btMultiBodyDynamicsWorld* world_;
};

}  // namespace tera
