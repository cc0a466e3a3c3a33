#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "blind/case_recording.h"
#include "blind/concealed.h"
#include "blind/measurement.h"
#include "blind/operator.h"

namespace tera::blind {

/// Joints of an excavator that stands: how they are, how they are driven and measured.
struct JointsCase {
  Forms forms{};
  Excavator excavator;  ///< its numbers off from those of the scenario
  AxisValues start_rad{};
  Habit habit;
  EncoderNoise noise;
  std::vector<std::size_t> measured;     ///< axes
  std::vector<std::size_t> hidden_axes;  ///< of what is hidden, in its order
};

/// `name` is the case's, for its streams.
CaseRecording RecordJoints(const JointsCase& joints, double duration_s, std::uint64_t seed,
                           const std::string& name);

}  // namespace tera::blind
