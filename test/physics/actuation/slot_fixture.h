#pragma once

#include <string>

#include "core/config/config.h"
#include "physics/actuation/actuation_mechanisms.h"

namespace tera {

/// The effects of a joint, gear or pump from YAML: "dead_band: {width: 0.1}".
inline Effects EffectsFrom(const std::string& yaml, EffectTarget target = EffectTarget::kJoint) {
  const Config config = Config::FromText(yaml, "effects.yaml");
  Effects effects = ReadEffects(config.root(), target, ActuationMechanisms());
  config.Finish();
  return effects;
}

}  // namespace tera
