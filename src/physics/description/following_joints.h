#pragma once

#include "physics/description/link_tree.h"

namespace tera {

/// Ties the joints of a tree that follow others to them, as `mimic` of a URDF says. A joint that
/// follows one that follows in its turn follows the first of them.
///
/// Model   q = ratio * q(leader) + offset. The leader's limits and rates become those that keep its
///         followers within theirs, and it starts there; a remark says where its limits are
///         narrower for that.
/// Omits   what bears the follower but its leader: it has no effort of its own.
///
/// Reports a leader that is not there, is fixed or is the joint itself by any number of others, and
/// limits that no place of the leader meets.
void TieFollowers(const MachineParts& parts, MachineModel* model);

}  // namespace tera
