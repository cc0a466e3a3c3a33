#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dataset/format/recording.h"
#include "diagnose/replay/axis_log.h"
#include "diagnose/statistics/series/series.h"

namespace tera {

/// What a joint's drive was measured to do, and the motion that it did it for.
///
/// Model   Position is smoothed by a Gaussian of -3 dB at `band_hz`; rate and acceleration are its
///         convolutions with the Gaussian's derivatives, so that nothing is differentiated by
///         itself and nothing comes late. Effort, and what a replay makes of the rate, pass the
///         same Gaussian. `inertial` and `weight` are those of all links beyond the joint, moved as
///         all measured joints were, on a machine that stands still and level; joints without
///         encoder stay where they are at first.
/// Omits   soil on tools, the ground, a base that moves.
struct EffortLog {
  std::string channel;  ///< "emps1/efforts/carriage_n"
  std::size_t joint = 0;
  double band_hz = 0;

  /// The encoder's steps: rate, over the whole time.
  double fine_s = 0;
  std::vector<double> fine_rate_radps;
  /// Gaussian over the fine steps, odd in number, of sum 1.
  std::vector<double> kernel;

  /// The grid of the comparison, four samples a period of the band, for the Gaussian passes some of
  /// what is beyond: fine step of each of its samples, and the quantities there. A gap where a side
  /// was not measured, or the joint rested, where friction takes what load there is.
  TimeNs first_ns = 0;
  std::vector<std::size_t> at_fine;
  Series measured;
  std::vector<double> inertial_nm, weight_nm, position_rad, rate_radps, acceleration_radps2;
};

/// One for each column of `efforts` that names a joint of the machine with an encoder; the others
/// are left out. Throws InputError where a column is of the wrong kind (_n of a joint that turns).
std::vector<EffortLog> MakeEffortLogs(const MachineModel& model, const std::string& channel,
                                      const TableRecording& efforts,
                                      const std::vector<NamedEncoders>& encoders);

}  // namespace tera
