#pragma once

#include <string>
#include <vector>

#include "core/config/config.h"
#include "physics/description/machine.h"

/// Links and joints as named in a description, not yet ordered as a tree.

namespace tera {

/// Position of a part in the input, for messages.
struct PartPlace {
  ConfigMap config;
  std::string part;  ///< "joint 'boom' of arm.urdf"; empty if `config` is the mapping of the part

  /// Reports `fault` at `key` of the part.
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
  std::string leader = "";  ///< name of the leading joint; empty if there is none
};

struct MachineParts {
  std::vector<LinkPart> links;
  std::vector<JointPart> joints;
  std::vector<std::string> driven;  ///< joints with drives, in the order of the description
  std::vector<std::string> remarks;
  /// True if all joint types are known. Otherwise checks of moving links are skipped.
  bool whole = true;
};

/// Orders the parts into `model`: root first, links[k + 1] the child of joints[k]. Reports joints
/// that name no link, links with two parents, loops and several roots. After such a fault it
/// returns false, and the model holds the parts that have an order. A link without mass takes the
/// masses of the links fixed to it (fixed_links.h). Moving bodies without mass and impossible
/// inertias are faults. Following joints are tied to their leaders.
bool OrderIntoTree(const MachineParts& parts, const ConfigMap& config, MachineModel* model);

}  // namespace tera
