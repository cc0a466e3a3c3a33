#pragma once

#include <memory>

#include "physics/description/machine.h"

class btMultiBody;
class btMultiBodyDynamicsWorld;

namespace tera {

/// Constrains a following joint to its leading joint.
///
/// Model   An unbounded row of the machine's constraints: the rates at the end of each step lead to
///         q = ratio * q(leader) + offset. The load of the follower acts on the leader times ratio,
///         as in a frictionless gear.
/// Omits   Compliance and play of the mechanism.
class JointTie {
 public:
  /// Ties link `bullet_link` of `body`; `body` and `world` must outlive the tie.
  JointTie(btMultiBody* body, int bullet_link, const Following& following,
           btMultiBodyDynamicsWorld* world);
  ~JointTie();
  JointTie(JointTie&&) noexcept;

 private:
  class Constraint;
  std::unique_ptr<Constraint> constraint_;
  btMultiBodyDynamicsWorld* world_;
};

}  // namespace tera
