#pragma once

#include <string>
#include <vector>

#include "core/config/config.h"
#include "physics/description/machine.h"

/// Links and joints as a description names them, before they are a tree.

namespace tera {

/// Where a part stands in the input, for messages.
struct PartPlace {
  ConfigMap config;
  std::string part;  ///< "joint 'boom' of arm.urdf", empty where `config` is the part's own mapping

  /// Reports `finding` at `key` of the part.
  void Fault(std::string_view key, const InputFault& fault) const;
};

struct LinkPart {
  Link link;
  PartPlace place;
};

struct JointPart {
  Joint joint;  ///< parent and child not yet set
  std::string parent, child;
  PartPlace place;
  std::string leader = "";  ///< name of the joint that it follows, empty where it follows none
};

struct MachineParts {
  std::vector<LinkPart> links;
  std::vector<JointPart> joints;
  std::vector<std::string> driven;   ///< joints that the description says are driven, in its order
  std::vector<std::string> remarks;  ///< of the machine
  bool whole = true;  ///< the kinds of all joints are known; else what moves cannot be judged
};

/// Puts the parts in order (root first, links[k + 1] the child of joints[k]) into `model`, and
/// reports joints that name no link, links with two parents, loops, several roots. After such a
/// fault the model holds what could be ordered, and false is returned. Masses of links fixed to one
/// that has none become its own (fixed_links.h); bodies without mass or with an impossible inertia
/// are faults. Joints that follow others are tied to them.
bool OrderIntoTree(const MachineParts& parts, const ConfigMap& config, MachineModel* model);

}  // namespace tera
