#include "core/types/effects.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>

#include "core/check.h"
#include "core/config/config_layers.h"

namespace tera {
namespace {

double ReadParameter(const ConfigMap& map, const EffectParameter& parameter) {
  const Range range = Between(parameter.lower, parameter.upper, std::string(parameter.unit));
  const std::string_view name = parameter.name;
  if (parameter.whole) {
    return static_cast<double>(
        parameter.otherwise
            ? map.Integer(name, range, static_cast<std::int64_t>(*parameter.otherwise))
            : map.Integer(name, range));
  }
  return parameter.otherwise ? map.Number(name, range, *parameter.otherwise)
                             : map.Number(name, range);
}

/// Text of the accepted values, such as "its parameters, {width: 0 to 0.9}, or none to take it
/// away".
std::string NeedOf(const Mechanism& mechanism) {
  std::vector<std::string> items;
  for (const EffectParameter& p : mechanism.parameters) {
    items.push_back(fmt::format("{}: {} to {}", p.name, p.lower, p.upper));
  }
  return fmt::format("{}, {{{}}}, or none to take it away",
                     items.empty() ? "a mapping without parameters" : "its parameters",
                     fmt::join(items, ", "));
}

/// Reports each effect in `config` whose mechanism exists in the library but acts only on other
/// targets.
void ReportMisplaced(const ConfigMap& config, EffectTarget target,
                     std::span<const Mechanism> library) {
  std::vector<std::string_view> fitting;
  for (const Mechanism& m : library) {
    if (m.ActsOn(target)) fitting.push_back(m.id);
  }
  std::vector<std::string_view> reported;
  for (const Mechanism& m : library) {
    const auto among = [&](const auto& ids) {
      return std::find(ids.begin(), ids.end(), m.id) != ids.end();
    };
    if (among(fitting) || among(reported) || !config.Has(m.id)) continue;
    reported.push_back(m.id);
    config.Fault(m.id, fmt::format("'{}' does not act on this target, {}; those that do: {}", m.id,
                                   target.name, fmt::join(fitting, ", ")));
  }
}

}  // namespace

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
    case Slot::kScene:
      return "scene";
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
    if (!mechanism.ActsOn(target)) continue;
    const auto map = internal::ConfigDocument::MapOrNone(config, mechanism.id, NeedOf(mechanism));
    if (!map) continue;
    Effect effect{&mechanism, {}};
    for (const EffectParameter& parameter : mechanism.parameters) {
      effect.values.push_back(ReadParameter(*map, parameter));
    }
    effects.push_back(std::move(effect));
  }
  ReportMisplaced(config, target, library);
  return effects;
}

}  // namespace tera
