#pragma once

#include <string>
#include <vector>

#include "core/time.h"
#include "dataset/format/recording.h"
#include "diagnose/replay/axis_log.h"
#include "physics/description/machine.h"
#include "sensors/sensor.h"

namespace tera {

/// What is to be diagnosed.
struct DiagnosisInput {
  const MachineModel* model = nullptr;
  std::string machine;                      ///< name in the recording
  std::string scenario;                     ///< name in the scenario
  TableRecording commands;                  ///< columns by the names of levers
  bool commands_are_the_scenarios = false;  ///< for the recording has none
  /// As the scenario has them, by the names that they have in the recording.
  std::vector<SensorDescription> sensors;
};

/// What a recording holds of one machine, within the time that is looked at.
struct Measurements {
  std::string recording;  ///< its folder
  std::vector<NamedEncoders> encoders;
  std::vector<TruthPose> poses;
  bool poses_were_measured = false;  ///< not simulated
  TableRecording efforts;            ///< of drives
  /// One for each of the scenario's sensors; empty of those that are none or were not recorded.
  std::vector<std::vector<ImuSample>> imus;
  std::vector<std::vector<GnssSample>> gnss;  ///< likewise
  /// When the first encoder or inertial unit of the machine measured, in all of the recording: what
  /// all times count from.
  TimeNs start_ns = 0;
};

/// A recording that is shorter leaves too few manoeuvres that nothing is fitted to.
inline constexpr double kShortestRecording_s = 20;

struct MeasurementOptions {
  double from_s = 0, to_s = 1e9;  ///< part of the recording to look at, from its first sample on
  bool needs_any = true;          ///< that nothing, or too little, was measured is an error
};

/// What was measured of the machine, checked. Throws InputError.
Measurements MeasurementsOf(const DiagnosisInput& input, const Recording& recording,
                            const MeasurementOptions& options = {});

}  // namespace tera
