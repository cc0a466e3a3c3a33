#pragma once

#include <memory>

#include "physics/actuation/load_friction.h"

class btMultiBody;
class btMultiBodyDynamicsWorld;

namespace tera {

/// What drives a joint during a step. Efforts are magnitudes; in newton metres, or newtons for a
/// joint that slides. Without any the joint swings freely.
struct JointTarget {
  double rate_radps = 0;
  double max_positive_nm = 0, max_negative_nm = 0;  ///< of the motor, by the effort's direction
  AxisFriction friction;
  double offset_nm = 0;  ///< pushes the joint the negative way, whoever drives it
};

/// Motor, friction and end stops of one joint with one degree of freedom.
///
/// Model   The motor reaches its target rate within the step as far as its effort allows; near a
///         stop the target shrinks so that the joint comes to rest on it. Dry friction brings the
///         joint to rest as far as its bounds allow, so that at the end of a step it opposes
///         motion or holds; viscous friction is its coefficient times the rate at the end of the
///         step. A stop keeps the joint from passing its limit with whatever effort that takes
///         (inelastic). All are solved together with all other joints and contacts of the machine.
///         Where motor and friction both hold a joint, the motor bears what it can.
/// Omits   compliance.
class JointDrive {
 public:
  /// For link `bullet_link` of `body`, which with `world` must outlive the drive.
  JointDrive(btMultiBody* body, int bullet_link, btMultiBodyDynamicsWorld* world);
  ~JointDrive();
  JointDrive(JointDrive&&) noexcept;

  void SetStops(double lower, double upper);
  void SetTarget(const JointTarget& target);
  /// Effort of motor and stops together over the last step of `dt_s`.
  double Effort(double dt_s) const;
  /// Effort of friction over the last step of `dt_s`.
  double Friction(double dt_s) const;

 private:
  class Constraint;
  std::unique_ptr<Constraint> constraint_;
  btMultiBodyDynamicsWorld* world_;
};

}  // namespace tera
