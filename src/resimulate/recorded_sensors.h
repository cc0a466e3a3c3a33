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

/// True for sensors that measure ranges: lidars and depth cameras.
bool MeasuresRanges(const SensorDescription& sensor);

/// True for sensors whose images are compared: those with colour images and without ranges.
bool TakesPictures(const SensorDescription& sensor);

/// A lidar or camera of a machine in the scenario, with a selection of its recorded scans or
/// images.
struct RecordedSensor {
  std::size_t machine = 0;
  const SensorDescription* description = nullptr;
  std::string channel;  ///< channel in the recording, "excavator1/lidar_roof"
  std::vector<ScanCaster::Scan> scans;
  std::string obstacle;  ///< reason why it cannot be simulated; empty if it can
};

/// A part of a recording, in seconds from the first scan of each sensor.
struct RecordedPart {
  double from_s = 0, to_s = 1e9;
};

/// Sensors of the scenario with recorded scans or images. For each sensor it selects up to 60 scans
/// or 40 images, evenly spaced. `names` are the machines' names in the recording. Keeps pointers
/// into the scenario.
std::vector<RecordedSensor> SeeingSensors(const Scenario& scenario,
                                          const std::vector<std::string>& names,
                                          const Recording& recording, const RecordedPart& part);

/// Sets the ground and the loads at the end of each scan, by advancing `stage` in order of time.
void WorkGround(RecordedStage* stage, std::vector<RecordedSensor>* sensors);

/// Explains why the pose of a sensor is unknown. Empty if it is known.
std::string ObstacleTo(const RecordedSensor& sensor, const RecordedMotion& motion,
                       const MachineModel& model);

}  // namespace tera
