#pragma once

#include <gtest/gtest.h>

#include <string>

#include "core/config/config.h"
#include "core/motion.h"
#include "sensors/sensor_mechanisms.h"

namespace tera::testing {

/// The effects that a target has by `yaml`, "{bias: {gyro_x_degps: 1}}".
inline Effects Given(EffectTarget target, const std::string& yaml) {
  const Config config = Config::FromText("target: " + yaml, "effects.yaml");
  Effects effects = ReadEffects(config.root().Map("target"), target, SensorMechanisms());
  config.Finish();
  return effects;
}

inline void ExpectNear(const Vec3& found, const Vec3& wanted, double tolerance) {
  EXPECT_LT((found - wanted).norm(), tolerance)
      << "found " << found.transpose() << ", wanted " << wanted.transpose();
}

}  // namespace tera::testing
