#pragma once

#include <string>
#include <vector>

#include "dataset/format/recording.h"
#include "diagnose/perception/perception_diagnosis.h"
#include "resimulate/recorded_sensors.h"
#include "sim/scenario/scenario.h"

namespace tera {

/// Parts of a recording to compare, and the threads to use.
struct PerceptionOptions {
  RecordedPart part;
  int threads = 1;
};

/// Compares the lidar and camera data of a recording with their simulation on the recorded
/// trajectory. Returns one list for each machine, with one entry for each of its recorded sensors.
/// `names` are the machines' names in the recording.
///
/// Throws InputError for an invalid recorded file.
std::vector<std::vector<PerceptionDiagnosis>> RunPerception(const Scenario& scenario,
                                                            const std::vector<std::string>& names,
                                                            const Recording& recording,
                                                            const PerceptionOptions& options);

}  // namespace tera
