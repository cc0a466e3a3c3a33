#pragma once

#include <string>
#include <vector>

#include "dataset/format/recording.h"
#include "diagnose/perception/perception_diagnosis.h"
#include "resimulate/recorded_sensors.h"
#include "sim/scenario/scenario.h"

namespace tera {

/// What of a recording is looked at, and by how much of this computer.
struct PerceptionOptions {
  RecordedPart part;
  int threads = 1;
};

/// Compares what the lidars and cameras of a scenario recorded with what they would see on
/// the recorded trajectory: one list a machine, one entry for each of its sensors that the
/// recording has. `names`: of the machines, in the recording.
///
/// Throws InputError where a recorded file is not as it must be.
std::vector<std::vector<PerceptionDiagnosis>> RunPerception(const Scenario& scenario,
                                                            const std::vector<std::string>& names,
                                                            const Recording& recording,
                                                            const PerceptionOptions& options);

}  // namespace tera
