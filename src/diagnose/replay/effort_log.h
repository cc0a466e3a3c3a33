#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/types/effects.h"
#include "dataset/format/recording.h"
#include "diagnose/replay/axis_log.h"
#include "diagnose/statistics/series/series.h"

namespace tera {

/// Measured effort of a joint's drive, and the measured motion.
///
/// Model   position is smoothed by a Gaussian of -3 dB at `band_hz`. Rate and acceleration are its
///         convolutions with the Gaussian's derivatives, so that no raw signal is differentiated or
///         delayed. Effort and a replay's friction pass the same Gaussian. `inertial` and `weight`
///         are those of all links beyond the joint, with the measured motion of all joints, on a
///         level machine at rest. Joints without encoder keep their initial position.
/// Omits   soil on tools, the ground, a moving base.
struct EffortLog {
  std::string channel;  ///< "emps1/efforts/carriage_n"
  std::size_t joint = 0;
  double band_hz = 0;

  /// The rate at the encoder's steps, over the whole time.
  double fine_s = 0;
  std::vector<double> fine_rate_radps;
  /// Smoothing weights: a Gaussian sampled at the fine steps, with an odd number of weights that
  /// sum to 1.
  std::vector<double> kernel;

  /// Grid of the comparison: the fine step of each sample, and the quantities there. It has four
  /// samples per period of the band, since the Gaussian passes some content above it. Gaps are
  /// where effort or motion was not measured, and where the joint rested, since static friction
  /// then takes any load.
  TimeNs first_ns = 0;
  std::vector<std::size_t> at_fine;
  Series measured;
  std::vector<double> inertial_nm, weight_nm, position_rad, rate_radps, acceleration_radps2;
};

/// One log for each column of `efforts` that names a joint of the machine with an encoder; other
/// columns are ignored. Throws InputError for a column of the wrong kind (_n for a revolute joint).
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
