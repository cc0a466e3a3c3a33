#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "blind/cases/case_recording.h"
#include "blind/plant/concealed.h"
#include "blind/plant/measurement.h"
#include "blind/plant/operator.h"

namespace tera::blind {

/// One hidden effect: its axis, and the joints without it.
struct HiddenInJoint {
  std::size_t axis = 0;
  Forms without{};
};

/// Joints of an excavator at rest: their forms, levers and measurement.
struct JointsCase {
  Forms forms{};
  Excavator excavator;  ///< its numbers differ from the scenario's
  AxisValues start_rad{};
  Habit habit;
  EncoderNoise noise;
  std::vector<std::size_t> measured;  ///< axes
  std::vector<HiddenInJoint> hidden;
};

/// `name` is the case's, part of the stream names.
CaseRecording RecordJoints(const JointsCase& joints, double duration_s, std::uint64_t seed,
                           const std::string& name);

}  // namespace tera::blind
