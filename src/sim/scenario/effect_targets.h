#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/types/effects.h"
#include "physics/description/machine.h"
#include "sensors/sensor.h"

namespace tera {

/// A part of a machine that effects can apply to, by its name in YAML.
struct NamedTarget {
  /// Joint, running gear, pump, sensor, "base", or an axis such as "encoders/boom".
  std::string name;
  EffectTarget kind;
  std::span<const Mechanism> library;  ///< mechanisms that apply to it
};

/// Name of the target for the motion of the whole machine.
inline constexpr std::string_view kBaseTarget = "base";

/// All targets of a machine: movable joints, running gears, pumps, the base, sensors and their
/// axes.
std::vector<NamedTarget> TargetsOf(const MachineModel& model,
                                   const std::vector<SensorDescription>& sensors);

/// True if `key` is a mapping or absent. Any other value is reported as a fault.
bool IsMappingOf(std::string_view need, const ConfigMap& config, std::string_view key);

}  // namespace tera
