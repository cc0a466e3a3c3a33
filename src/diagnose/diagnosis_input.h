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

/// Machine, levers and sensors of a diagnosis. A lever is the input of a joint, track or wheel set,
/// -1 to 1.
struct DiagnosisInput {
  const MachineModel* model = nullptr;
  std::string machine;                      ///< name in the recording
  std::string scenario;                     ///< name in the scenario
  TableRecording commands;                  ///< columns are named by levers
  bool commands_are_the_scenarios = false;  ///< true if the recording has no commands
  /// The scenario's sensors, by their names in the recording.
  std::vector<SensorDescription> sensors;
  Tolerances tolerances;  ///< the owner's expected deviations
};

/// An encoder axis with inverted sign.
struct ReversedAxis {
  std::string target;   ///< "encoders/boom"
  std::string channel;  ///< "excavator1/encoders"
  std::string axis;     ///< joint
  bool is_documented = false;
  double pivot_rad = 0;  ///< position that the inversion does not change
  /// Correlation of the encoder's rate with the rate of inertial units about the joint, and with
  /// the joint's lever.
  double with_units = 0, with_lever = 0;
  double p = 1;  ///< p-value of correlations that are so steadily negative
  /// RMS of the encoder's rate minus the rate of the inertial units: as recorded, and with the sign
  /// inverted.
  double rms_before_radps = 0, rms_after_radps = 0;
};

/// A receiver whose clock is off by seconds.
struct OffsetReceiver {
  std::string target;       ///< the receiver's name: "gnss_left"
  std::size_t sensor = 0;   ///< index among the scenario's sensors
  double documented_s = 0;  ///< clock offset in the scenario; positive: clock ahead
  double tolerance_s = 0;  ///< smaller shifts are within tolerance, or found by the motion estimate
  double shift_s = 0, sigma_s = 0;  ///< additional offset; positive: clock ahead
  double p = 1;                     ///< p-value of such a steady gain over all other offsets
  /// RMS of the receiver's displacement per second minus that of running gear and joints: with the
  /// recorded stamps, and with corrected stamps.
  double rms_before_m = 0, rms_after_m = 0;
};

/// Measurements of one machine in the diagnosed part of a recording.
struct Measurements {
  std::string recording;  ///< its folder
  std::vector<NamedEncoders> encoders;
  std::vector<TruthPose> poses;
  bool poses_were_measured = false;  ///< true if the poses come from a real recording
  /// Poses of the base, estimated from all sensors if no poses were recorded. Only the replay of
  /// the base uses these poses.
  std::vector<TruthPose> estimated_poses = {};
  TableRecording efforts;  ///< efforts of the drives
  /// One list per sensor of the scenario, empty for a sensor of another kind or without a
  /// recording.
  std::vector<std::vector<ImuSample>> imus;
  std::vector<std::vector<GnssSample>> gnss;  ///< likewise
  /// Axes with inverted sign. `encoders` has the corrected sign.
  std::vector<ReversedAxis> reversed = {};
  /// Receivers whose clocks were off. `gnss` has corrected stamps.
  std::vector<OffsetReceiver> offset_receivers = {};
  /// Zero of all times: the first sample of an encoder or inertial unit in the whole recording.
  /// Without both, the first sample of a receiver.
  TimeNs start_ns = 0;
};

}  // namespace tera
