#pragma once

#include <optional>
#include <string>

#include "core/config/config.h"
#include "physics/description/link_tree.h"
#include "physics/description/machine.h"

/// Parts of ReadMachine, each for some keys of a machine description.

namespace tera {

/// Reads `links:` and `joints:` of TERA's own form.
MachineParts ReadParts(const ConfigMap& config);

/// Reads links and joints of the URDF named by `urdf:`. The optional TERA keys of `links:` (label)
/// and `joints:` (rates, effort, start) override it. Empty after a fault of the file itself.
std::optional<MachineParts> ReadUrdfParts(const ConfigMap& config, AbsentMeshes absent);

/// Reads the joint keys that both forms share. Absent keys leave `joint` unchanged.
void ReadJointActuation(const ConfigMap& config, Joint* joint);
SemanticClass ReadLabel(const ConfigMap& config, SemanticClass otherwise);
/// Reads `mesh:`, `node:` and `scale:` of a visual, without a pose.
Visual ReadMesh(const ConfigMap& config);
/// Index of the link named by `key`, or 0 after a fault.
int ReadLinkName(const ConfigMap& config, std::string_view key, const MachineModel& model);

/// Reads `tracks:`, `wheels:` and `gauge_m:`.
void ReadRunningGear(const ConfigMap& config, MachineModel* model);
/// Reads `shovels:`, `hull_points:` and `frames:`.
void ReadEquipment(const ConfigMap& config, MachineModel* model);
/// Reads `linkages:`, `hydraulics:`, `cylinders:` and `pumps:`. Call it after joints and running
/// gear are read.
void ReadHydraulics(const ConfigMap& config, MachineModel* model);

}  // namespace tera
