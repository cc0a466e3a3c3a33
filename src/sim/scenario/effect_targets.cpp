#include "sim/scenario/effect_targets.h"

#include <fmt/format.h>

#include "core/config/fault_text.h"
#include "physics/actuation/actuation_mechanisms.h"
#include "physics/traction/ground_mechanisms.h"
#include "sensors/sensor_mechanisms.h"

namespace tera {

std::vector<NamedTarget> TargetsOf(const MachineModel& model,
                                   const std::vector<SensorDescription>& sensors) {
  std::vector<NamedTarget> targets;
  for (const Joint& joint : model.joints) {
    if (joint.type == JointType::kFixed) continue;
    targets.push_back({joint.name, EffectTarget::kJoint, ActuationMechanisms()});
  }
  for (const RunningGear& gear : model.ground_tools.gears) {
    targets.push_back({gear.name, EffectTarget::kGear, ActuationMechanisms()});
  }
  for (const Pump& pump : model.pumps) {
    targets.push_back({pump.name, EffectTarget::kPump, ActuationMechanisms()});
  }
  if (!model.ground_tools.gears.empty()) {
    targets.push_back({std::string(kBaseTarget), EffectTarget::kBase, GroundMechanisms()});
  }
  for (const SensorDescription& sensor : sensors) {
    const SensorKind& kind = KindOf(sensor);
    targets.push_back({sensor.name, kind.target, SensorMechanisms()});
    if (!kind.axes) continue;
    for (const EncoderAxis& axis : kind.axes(sensor, model)) {
      targets.push_back({sensor.name + "/" + axis.name, kind.axis_target, SensorMechanisms()});
    }
  }
  return targets;
}

bool IsMappingOf(std::string_view need, const ConfigMap& config, std::string_view key) {
  if (!config.IsText(key)) return true;
  config.Fault(key, fault::Mistyped(fmt::format("'{}'", config.Text(key)), std::string(need)));
  return false;
}

}  // namespace tera
