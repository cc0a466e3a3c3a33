#pragma once

#include <string>
#include <vector>

#include "core/config/config.h"
#include "physics/description/machine.h"

/// Links and joints as a description names them, without the order of a tree.

namespace tera {

/// Position of a part in the input, for messages.
struct PartPlace {
  ConfigMap config;
  std::string part;  ///< "joint 'boom' of arm.urdf"; empty if `config` is the part's own mapping

  /// Reports `finding` at `key` of the part.
  void Fault(std::string_view key, const InputFault& fault) const;
};

struct LinkPart {
  Link link;
  PartPlace place;
};

struct JointPart {
  Joint joint;  ///< without parent and child indices
  std::string parent, child;
  PartPlace place;
  std::string leader = "";  ///< name of the leading joint; empty if the joint follows none
};

struct MachineParts {
  std::vector<LinkPart> links;
  std::vector<JointPart> joints;
  std::vector<std::string> driven;   ///< joints with drives, in the description's order
  std::vector<std::string> remarks;  ///< remarks on the machine
  bool whole = true;  ///< all joint types are known; otherwise no check of moving links is possible
};

/// Orders the parts into `model`: root first, links[k + 1] the child of joints[k]. Reports joints
/// that name no link, links with two parents, loops and several roots. After such a fault the
/// function returns false, and the model holds the parts that have an order. A link without mass
/// takes the masses of the links fixed to it (fixed_links.h). Moving bodies without mass and
/// impossible inertias are faults. Following joints are tied to their leaders.
bool OrderIntoTree(const MachineParts& parts, const ConfigMap& config, MachineModel* model);

}  // namespace tera
