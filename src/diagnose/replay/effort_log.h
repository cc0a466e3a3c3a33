#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dataset/format/recording.h"
#include "diagnose/replay/axis_log.h"
#include "diagnose/statistics/series/series.h"

namespace tera {

/// The measured effort of a joint's drive, and the measured motion.
///
/// Model   position is smoothed by a Gaussian of -3 dB at `band_hz`; rate and acceleration are its
///         convolutions with the Gaussian's derivatives, so that no raw signal is differentiated
///         and none is delayed. Effort and a replay's friction pass the same Gaussian. `inertial`
///         and `weight` are those of all links beyond the joint, moved as all joints were measured,
///         on a machine that stands still and level; joints without encoder stay at their initial
///         position.
/// Omits   soil on tools, the ground, a base that moves.
struct EffortLog {
  std::string channel;  ///< "emps1/efforts/carriage_n"
  std::size_t joint = 0;
  double band_hz = 0;

  /// The rate at the encoder's steps, over the whole time.
  double fine_s = 0;
  std::vector<double> fine_rate_radps;
  /// Gaussian over the fine steps, odd in number, of sum 1.
  std::vector<double> kernel;

  /// The grid of the comparison, with four samples per period of the band, since the Gaussian
  /// passes some of what is beyond: the fine step of each sample, and the quantities there. There
  /// is a gap where effort or motion was not measured, and where the joint rested, since friction
  /// then bears any load.
  TimeNs first_ns = 0;
  std::vector<std::size_t> at_fine;
  Series measured;
  std::vector<double> inertial_nm, weight_nm, position_rad, rate_radps, acceleration_radps2;
};

/// One log for each column of `efforts` that names a joint of the machine with an encoder; other
/// columns are ignored. Throws InputError where a column is of the wrong kind (_n of a joint that
/// turns).
std::vector<EffortLog> MakeEffortLogs(const MachineModel& model, const std::string& channel,
                                      const TableRecording& efforts,
                                      const std::vector<NamedEncoders>& encoders);

}  // namespace tera
