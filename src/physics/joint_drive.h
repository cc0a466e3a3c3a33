#pragma once

#include <memory>

class btMultiBody;
class btMultiBodyDynamicsWorld;

namespace tera {

/// Motor and end stops of one joint with one degree of freedom.
///
/// Model   The motor reaches its target rate within the step as far as its effort allows; near a
///         stop the target shrinks so that the joint comes to rest on it. A stop keeps the joint
///         from passing its limit with whatever effort that takes (inelastic). Both are solved
///         together with all other joints and contacts of the machine.
/// Omits   compliance, friction, leakage.
class JointDrive {
 public:
  /// For link `bullet_link` of `body`, which with `world` must outlive the drive.
  JointDrive(btMultiBody* body, int bullet_link, btMultiBodyDynamicsWorld* world);
  ~JointDrive();
  JointDrive(JointDrive&&) noexcept;

  void SetStops(double lower, double upper);
  /// `max_effort` 0 lets the joint swing freely.
  void SetTarget(double rate, double max_effort);
  /// Effort of motor and stops together over the last step of `dt_s`.
  double Effort(double dt_s) const;

 private:
  class Constraint;
  std::unique_ptr<Constraint> constraint_;
  btMultiBodyDynamicsWorld* world_;
};

}  // namespace tera
