#pragma once

#include <string>
#include <vector>

#include "core/time.h"
#include "core/types/tolerance.h"
#include "dataset/format/recording.h"
#include "diagnose/replay/axis_log.h"
#include "physics/description/machine.h"
#include "sensors/sensor.h"

namespace tera {

/// The machine, levers and sensors of a diagnosis.
struct DiagnosisInput {
  const MachineModel* model = nullptr;
  std::string machine;                      ///< name in the recording
  std::string scenario;                     ///< name in the scenario
  TableRecording commands;                  ///< columns by the names of levers
  bool commands_are_the_scenarios = false;  ///< since the recording has none
  /// The scenario's sensors by their names in the recording.
  std::vector<SensorDescription> sensors;
  Tolerances tolerances;  ///< what the owner takes as expected
};

/// An axis of encoders that counts backwards.
struct ReversedAxis {
  std::string target;   ///< "encoders/boom"
  std::string channel;  ///< "excavator1/encoders"
  std::string axis;     ///< the joint's name
  bool is_documented = false;
  double pivot_rad = 0;  ///< about which it counts backwards
  /// Correlation of its rate with that of inertial units about the joint, and with its lever.
  double with_units = 0, with_lever = 0;
  double p = 1;  ///< of both being so steadily negative by chance
  /// RMS of its rate less that of the units, as it counts and turned about.
  double rms_before_radps = 0, rms_after_radps = 0;
};

/// A receiver whose clock is ahead or behind by seconds.
struct OffsetReceiver {
  std::string target;               ///< its name, "gnss_left"
  std::size_t sensor = 0;           ///< its place among the scenario's sensors
  double documented_s = 0;          ///< by how much its clock is ahead by the scenario
  double tolerance_s = 0;           ///< what is as expected beside that, or found otherwise
  double shift_s = 0, sigma_s = 0;  ///< by how much more it is ahead
  double p = 1;                     ///< of as steady a gain over all other clocks by chance
  /// RMS of what it says that it moves by in a second less what running gear and joints say, with
  /// its own stamps and anew.
  double rms_before_m = 0, rms_after_m = 0;
};

/// The measurements of one machine within the part of a recording that is diagnosed.
struct Measurements {
  std::string recording;  ///< its folder
  std::vector<NamedEncoders> encoders;
  std::vector<TruthPose> poses;
  bool poses_were_measured = false;  ///< not simulated
  /// Where there are none, poses of the base by all sensors, for its own replay alone.
  std::vector<TruthPose> estimated_poses = {};
  TableRecording efforts;  ///< of drives
  /// One list for each of the scenario's sensors; empty where it is no inertial unit, or was not
  /// recorded.
  std::vector<std::vector<ImuSample>> imus;
  std::vector<std::vector<GnssSample>> gnss;  ///< one list for each sensor, as `imus`
  /// Axes that counted backwards, and count forwards in `encoders`.
  std::vector<ReversedAxis> reversed = {};
  /// Receivers whose clocks were off, and whose samples in `gnss` are stamped anew.
  std::vector<OffsetReceiver> offset_receivers = {};
  /// The time of the first sample of an encoder or inertial unit in the whole recording, from which
  /// all times count.
  TimeNs start_ns = 0;
};

}  // namespace tera
