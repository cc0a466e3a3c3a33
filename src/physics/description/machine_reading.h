#pragma once

#include <optional>
#include <string>

#include "core/config/config.h"
#include "physics/description/link_tree.h"
#include "physics/description/machine.h"

/// The parts of ReadMachine, each reading some keys of a machine description.

namespace tera {

/// `links:` and `joints:` of TERA's own form.
MachineParts ReadParts(const ConfigMap& config);

/// Links and joints of the URDF that `urdf:` names, with the optional TERA keys of `links:` (label)
/// and `joints:` (rates, effort, start) laid over them; nothing after a fault of the file itself.
std::optional<MachineParts> ReadUrdfParts(const ConfigMap& config, AbsentMeshes absent);

/// Keys of a joint that both forms share; what is absent stays as it is in `joint`.
void ReadJointActuation(const ConfigMap& config, Joint* joint);
SemanticClass ReadLabel(const ConfigMap& config, SemanticClass otherwise);
/// `mesh:`, `node:`, `scale:` of a visual; no pose.
Visual ReadMesh(const ConfigMap& config);
/// The link that `key` names, or 0 after a fault.
int ReadLinkName(const ConfigMap& config, std::string_view key, const MachineModel& model);

/// `tracks:`, `wheels:`, `gauge_m:`.
void ReadRunningGear(const ConfigMap& config, MachineModel* model);
/// `shovels:`, `hull_points:`, `frames:`.
void ReadEquipment(const ConfigMap& config, MachineModel* model);
/// `linkages:`, `hydraulics:`, `cylinders:`, `pumps:`, after joints and running gear.
void ReadHydraulics(const ConfigMap& config, MachineModel* model);

}  // namespace tera
