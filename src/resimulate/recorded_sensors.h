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

/// True if a sensor measures ranges, as do lidars and cameras with depth.
bool MeasuresRanges(const SensorDescription& sensor);

/// True if the comparison uses a sensor's images: it has colour images and no ranges.
bool TakesPictures(const SensorDescription& sensor);

/// An exteroceptive sensor of a scenario's machine, with some of its recorded scans or images.
struct RecordedSensor {
  std::size_t machine = 0;
  const SensorDescription* description = nullptr;
  std::string channel;  ///< channel of the recording, "excavator1/lidar_roof"
  std::vector<ScanCaster::Scan> scans;
  std::string obstacle;  ///< obstacle to its simulation; empty if none
};

/// Part of a recording, in seconds from each sensor's first scan.
struct RecordedPart {
  double from_s = 0, to_s = 1e9;
};

/// Sensors of a scenario with recorded scans or images: up to 60 scans or 40 images each, evenly
/// spread. `names` are the machines' names in the recording. Keeps pointers into the scenario.
std::vector<RecordedSensor> SeeingSensors(const Scenario& scenario,
                                          const std::vector<std::string>& names,
                                          const Recording& recording, const RecordedPart& part);

/// Sets ground and loads of each scan at its end, by advancing the stage in time order.
void WorkGround(RecordedStage* stage, std::vector<RecordedSensor>* sensors);

/// Reason for an unknown sensor pose; empty if it is known.
std::string ObstacleTo(const RecordedSensor& sensor, const RecordedMotion& motion,
                       const MachineModel& model);

}  // namespace tera
