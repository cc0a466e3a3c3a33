#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/types/effects.h"
#include "dataset/format/recording.h"
#include "diagnose/replay/axis_log.h"
#include "diagnose/statistics/series/series.h"

namespace tera {

/// Measured effort of a joint's drive and the measured motion.
///
/// Model   A Gaussian with -3 dB at `band_hz` smooths the position. Rate and acceleration are
///         convolutions with the Gaussian's derivatives, so no raw signal is differentiated or
///         delayed. The same Gaussian smooths the measured effort and a replay's friction.
///         `inertial` and `weight` are the efforts of all links beyond the joint, for the measured
///         motion of all joints on a level, standing machine. Joints without an encoder keep their
///         initial position.
/// Omits   Soil on tools, ground contact, a moving base.
struct EffortLog {
  std::string channel;  ///< "emps1/efforts/carriage_n"
  std::size_t joint = 0;
  double band_hz = 0;

  /// Rate at the encoder's steps, over the whole log.
  double fine_s = 0;
  std::vector<double> fine_rate_radps;
  /// Smoothing weights: a Gaussian sampled at the encoder's steps, with an odd number of weights
  /// and a sum of 1.
  std::vector<double> kernel;

  /// Grid of the comparison: the fine step of each sample, and the quantities there. The grid has
  /// four samples per period of `band_hz`, because the Gaussian passes some content above the band.
  /// A sample is a gap if effort or motion was not measured, or if the joint rested. At rest,
  /// static friction supports any load.
  TimeNs first_ns = 0;
  std::vector<std::size_t> at_fine;
  Series measured;
  std::vector<double> inertial_nm, weight_nm, position_rad, rate_radps, acceleration_radps2;
};

/// Makes one log per column of `efforts` that names a joint with an encoder. Other columns are
/// ignored. Throws InputError for a column of the wrong kind (_n for a revolute joint).
std::vector<EffortLog> MakeEffortLogs(const MachineModel& model, const std::string& channel,
                                      const TableRecording& efforts,
                                      const std::vector<NamedEncoders>& encoders);

/// Effort of a joint's drive for the measured motion.
///
/// Model   effort = inertial + weight + friction(rate) + offset, with friction and offset of the
///         simulator's slot load_friction, through the log's Gaussian.
/// Omits   friction at rest, where the log has gaps.
class EffortReplay {
 public:
  /// Both must outlive it.
  EffortReplay(const MachineModel& model, const EffortLog& log) : model_(model), log_(log) {}

  /// Efforts with `effects` in place of the joint's own, one for each sample of the log's grid.
  std::vector<double> Predict(const Effects& effects) const;

 private:
  const MachineModel& model_;
  const EffortLog& log_;
};

}  // namespace tera
