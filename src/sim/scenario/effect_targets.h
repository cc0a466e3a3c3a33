#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/types/effects.h"
#include "physics/description/machine.h"
#include "sensors/sensor.h"

namespace tera {

/// A target of mechanisms on a machine, by its name in YAML.
struct NamedTarget {
  std::string name;  ///< joint, running gear, pump, sensor or axis, "encoders/boom"; "base"
  EffectTarget kind;
  std::span<const Mechanism> library;  ///< library of its mechanisms
};

/// The target of the whole machine's motion.
inline constexpr std::string_view kBaseTarget = "base";

/// All targets of a machine: moving joints, running gears, pumps, the base, sensors and their axes.
std::vector<NamedTarget> TargetsOf(const MachineModel& model,
                                   const std::vector<SensorDescription>& sensors);

/// True if `key` has a mapping or is absent. A word or a number there is a fault.
bool IsMappingOf(std::string_view need, const ConfigMap& config, std::string_view key);

}  // namespace tera
