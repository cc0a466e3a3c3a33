#pragma once

#include <memory>

#include "physics/description/machine.h"

class btMultiBody;
class btMultiBodyDynamicsWorld;

namespace tera {

/// Holds a joint where the one that it follows takes it.
///
/// Model   a row of the machine's constraints, without bound: at the end of each step the rates are
///         those that bring q = ratio * q(leader) + offset about. The load of the follower
///         acts on the leader times ratio, as that of a gear without friction.
/// Omits   compliance and play of what ties them.
class JointTie {
 public:
  /// For link `bullet_link` of `body`, which with `world` must outlive the tie.
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
