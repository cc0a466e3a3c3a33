#pragma once

#include <memory>

#include "physics/actuation/load_friction.h"

class btMultiBody;
class btMultiBodyDynamicsWorld;

namespace tera {

/// Drive of a joint during a step. Efforts are magnitudes in newton metres, or newtons for
/// prismatic joints. A joint without effort swings freely.
struct JointTarget {
  double rate_radps = 0;
  double max_positive_nm = 0, max_negative_nm = 0;  ///< of the motor, by effort direction
  AxisFriction friction;
  double offset_nm = 0;  ///< pushes the joint in the negative direction, independently of the motor
};

/// Motor, friction and end stops of one joint with one degree of freedom.
///
/// Model   the motor reaches its target rate within the step, up to its effort limit. Near a stop
///         the target shrinks so that the joint comes to rest at the stop. Dry friction brings the
///         joint to rest within its bounds: at the end of a step it opposes motion or holds.
///         Viscous friction is its coefficient times the rate at the end of the step. A stop
///         enforces its limit with unlimited effort (inelastic). All rows are solved together with
///         all other joints and contacts of the machine. If motor and friction both hold a joint,
///         the motor bears the load up to its limit.
/// Omits   compliance.
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
