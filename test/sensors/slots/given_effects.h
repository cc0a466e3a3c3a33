#pragma once

#include <string>

#include "core/config.h"
#include "sensors/sensor_mechanisms.h"

namespace tera::testing {

/// The effects that a target has by `yaml`, "{bias: {gyro_x_degps: 1}}".
inline Effects Given(EffectTarget target, const std::string& yaml) {
  const Config config = Config::FromText("target: " + yaml, "effects.yaml");
  Effects effects = ReadEffects(config.root().Map("target"), target, SensorMechanisms());
  config.Finish();
  return effects;
}

}  // namespace tera::testing
