#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/types/effects.h"
#include "physics/description/machine.h"
#include "sensors/sensor.h"

namespace tera {

/// Something of a machine that mechanisms act on, by its name in YAML.
struct NamedTarget {
  std::string name;  ///< of a joint, running gear, pump, sensor or axis, "encoders/boom"; "base"
  EffectTarget kind;
  std::span<const Mechanism> library;  ///< in which its mechanisms are
};

/// The target of the whole machine's motion.
inline constexpr std::string_view kBaseTarget = "base";

/// All targets of a machine: moving joints, running gears, pumps, the base, sensors and their axes.
std::vector<NamedTarget> TargetsOf(const MachineModel& model,
                                   const std::vector<SensorDescription>& sensors);

/// Whether a mapping stands at `key`, if anything; a word or a number there is a fault.
bool IsMappingOf(std::string_view need, const ConfigMap& config, std::string_view key);

}  // namespace tera
