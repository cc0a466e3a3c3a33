#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "blind/cases/case_recording.h"
#include "blind/plant/concealed.h"
#include "blind/plant/measurement.h"
#include "blind/plant/operator.h"

namespace tera::blind {

/// One thing that is hidden: where, and how the joints would be without it.
struct HiddenInJoint {
  std::size_t axis = 0;
  Forms without{};
};

/// Joints of an excavator that stands: how they are, how they are driven and measured.
struct JointsCase {
  Forms forms{};
  Excavator excavator;  ///< its numbers off from those of the scenario
  AxisValues start_rad{};
  Habit habit;
  EncoderNoise noise;
  std::vector<std::size_t> measured;  ///< axes
  std::vector<HiddenInJoint> hidden;
};

/// `name` is the case's, for its streams.
CaseRecording RecordJoints(const JointsCase& joints, double duration_s, std::uint64_t seed,
                           const std::string& name);

}  // namespace tera::blind
