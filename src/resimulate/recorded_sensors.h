#pragma once

#include <string>
#include <vector>

#include "dataset/format/recording.h"
#include "resimulate/motion/recorded_motion.h"
#include "resimulate/recorded_stage.h"
#include "resimulate/scan_caster.h"
#include "sensors/sensor.h"
#include "sim/scenario/scenario.h"

namespace tera {

/// Whether a sensor measures ranges, as lidars and cameras with depth do.
bool MeasuresRanges(const SensorDescription& sensor);

/// Whether a sensor's pictures are what it is compared by: they are of colour, and it measures no
/// ranges.
bool TakesPictures(const SensorDescription& sensor);

/// A sensor of a scenario's machine that sees, and some of its scans or pictures in a recording.
struct RecordedSensor {
  std::size_t machine = 0;
  const SensorDescription* description = nullptr;
  std::string channel;  ///< "excavator1/lidar_roof", of the recording
  std::vector<ScanCaster::Scan> scans;
  std::string obstacle;  ///< why nothing can be simulated for it; empty where it can
};

/// Part of a recording, in seconds from the first scan of each sensor on.
struct RecordedPart {
  double from_s = 0, to_s = 1e9;
};

/// The sensors of a scenario that a recording has scans or pictures of: up to 60 scans, or 40
/// pictures, evenly spread. `names` are those of the machines in the recording. Keeps pointers into
/// the scenario.
std::vector<RecordedSensor> SeeingSensors(const Scenario& scenario,
                                          const std::vector<std::string>& names,
                                          const Recording& recording, const RecordedPart& part);

/// Gives each scan the ground and the loads at its end, working the stage in the order of time.
void WorkGround(RecordedStage* stage, std::vector<RecordedSensor>* sensors);

/// Why it is not known where a sensor was; empty where it is.
std::string ObstacleTo(const RecordedSensor& sensor, const RecordedMotion& motion,
                       const MachineModel& model);

}  // namespace tera
