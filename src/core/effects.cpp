#include "core/effects.h"

#include <algorithm>
#include <string>

#include "core/check.h"

namespace tera {

std::string_view NameOf(Slot slot) {
  switch (slot) {
    case Slot::kCommandTiming:
      return "command_timing";
    case Slot::kLeverMap:
      return "lever_map";
    case Slot::kFlow:
      return "flow";
    case Slot::kActuator:
      return "actuator";
    case Slot::kKinematicGain:
      return "kinematic_gain";
    case Slot::kLoadFriction:
      return "load_friction";
    case Slot::kGround:
      return "ground";
    case Slot::kSensorGeometry:
      return "sensor_geometry";
    case Slot::kSensorStatic:
      return "sensor_static";
    case Slot::kSensorTiming:
      return "sensor_timing";
  }
  TERA_CHECK(false, static_cast<int>(slot));
  return {};
}

bool Mechanism::ActsOn(EffectTarget target) const {
  return std::find(targets.begin(), targets.end(), target) != targets.end();
}

double Effect::operator[](std::string_view parameter) const {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (mechanism->parameters[i].name == parameter) return values[i];
  }
  TERA_CHECK(false, std::string(mechanism->id), std::string(parameter));
  return 0;
}

const Effect* FindEffect(const Effects& effects, std::string_view id) {
  for (const Effect& effect : effects) {
    if (effect.mechanism->id == id) return &effect;
  }
  return nullptr;
}

Effects ReadEffects(const ConfigMap& config, EffectTarget target,
                    std::span<const Mechanism> library) {
  Effects effects;
  for (const Mechanism& mechanism : library) {
    if (!mechanism.ActsOn(target) || !config.Has(mechanism.id)) continue;
    if (config.IsText(mechanism.id)) {
      config.Choice(mechanism.id, {"none"});
      continue;
    }
    const ConfigMap map = config.Map(mechanism.id);
    Effect effect{&mechanism, {}};
    for (const EffectParameter& parameter : mechanism.parameters) {
      const Range range = Between(parameter.lower, parameter.upper, std::string(parameter.unit));
      effect.values.push_back(parameter.otherwise
                                  ? map.Number(parameter.name, range, *parameter.otherwise)
                                  : map.Number(parameter.name, range));
    }
    effects.push_back(std::move(effect));
  }
  return effects;
}

}  // namespace tera
