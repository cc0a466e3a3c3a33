#pragma once

#include <string>
#include <vector>

#include "dataset/format/recording.h"
#include "diagnose/perception/perception_diagnosis.h"
#include "resimulate/recorded_sensors.h"
#include "sim/scenario/scenario.h"

namespace tera {

/// Part of the recording to compare, and the number of threads.
struct PerceptionOptions {
  RecordedPart part;
  int threads = 1;
};

/// Compares recorded lidar and camera data with their simulation on the recorded trajectory.
/// Returns one list per machine, with one entry per recorded sensor. `names` are the machines'
/// names in the recording.
///
/// Throws InputError for an invalid recorded file.
std::vector<std::vector<PerceptionDiagnosis>> RunPerception(const Scenario& scenario,
                                                            const std::vector<std::string>& names,
                                                            const Recording& recording,
                                                            const PerceptionOptions& options);

}  // namespace tera
