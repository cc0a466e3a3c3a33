#pragma once

#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "core/motion.h"
#include "core/units.h"
#include "diagnose/perception/perception_diagnosis.h"
#include "resimulate/sensor_calibration.h"

namespace tera::testing {

/// True deviation of a sensor from its description.
///
/// Frames  B link; S sensor as documented; T true sensor: p_BT = p_BS + shift_B, R_BT = R_BS
///         R(rpy).
struct TrueSensor {
  Vec3 shift_B_m = Vec3::Zero();
  Vec3 rpy_deg = Vec3::Zero();
  double range_bias_m = 0, range_factor = 1;
  double clock_offset_s = 0;

  SensorCalibration Calibration(const Pose& X_BS) const {
    const Vec3 rpy_rad = rpy_deg * kDeg;
    const Mat3 R_ST = RotationFromRpy(rpy_rad.x(), rpy_rad.y(), rpy_rad.z());
    return {MakePose(X_BS.translation() + shift_B_m, X_BS.linear() * R_ST), range_factor,
            range_bias_m, clock_offset_s};
  }
};

inline std::string_view IdOf(const PerceptionFinding& found) {
  return found.finding.term.candidate->mechanism->id;
}

inline const std::string& TargetOf(const PerceptionFinding& found) {
  return found.finding.term.candidate->target;
}

inline ParameterEstimate EstimateOf(const PerceptionFinding& found, const std::string& name) {
  for (const ParameterEstimate& estimate : found.finding.parameters) {
    if (estimate.name == name) return estimate;
  }
  ADD_FAILURE() << "no parameter " << name;
  return {};
}

inline double NumberOf(const PerceptionFinding& found, const std::string& name) {
  return EstimateOf(found, name).value;
}

}  // namespace tera::testing
