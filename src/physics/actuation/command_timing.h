#pragma once

#include <cstdint>
#include <vector>

#include "core/random.h"
#include "core/types/effects.h"

namespace tera {

/// Timing errors of a command between lever and valve. The defaults have none.
struct CommandTimingParameters {
  double hold_period_s = 0;  ///< 0: sampled in every step
  double hold_phase = 0;     ///< time of the first message after t = 0, as a share of the period
  double drop_period_s = 0;  ///< period of the messages; 0 for no losses
  double drop_probability = 0;
  double delay_s = 0;
  double delay_spread_s = 0;  ///< standard deviation of the delay over the parts of a command
};

CommandTimingParameters CommandTimingOf(const Effects& effects);

/// Slot `command_timing` of one lever: sampling by the sender, lost messages and delay.
///
/// Model   input_hold: the command at t = (k + phase) P is held until the next such time. Until the
///         first such time, the first command is held.
///         command_drops: each message k P .. (k + 1) P is lost with a given probability,
///         independently. The last received command is held meanwhile.
///         command_delay: y(t) = u(t - d). u is constant over each step and y is its mean over a
///         step, so that the sum of commands is exact for any d. With a spread s, y is the mean
///         over a uniform distribution of delays from d - w / 2 to d + w / 2. Its width w is
///         sqrt(12) s but at most 2 d, so that no command acts early. The distribution and the step
///         together count as one uniform distribution of the same variance, taken at the middle of
///         each step.
/// Omits   Jitter of the delay; reordered messages; the edge of the distribution within a step, an
///         error of dt^2 / (8 w) of the sum of commands.
class CommandTiming {
 public:
  /// `drops` decides which messages are lost. `first_step` is the index of the first step.
  CommandTiming(const CommandTimingParameters& parameters, const Stream& drops,
                std::int64_t first_step);

  /// The command at the valve during a step with the lever at `command`. `dt_s` is the same in
  /// every step.
  double Step(double command, double dt_s) { return acts_ ? Act(command, dt_s) : command; }

 private:
  double Act(double command, double dt_s);
  double Hold(double command, double t_s);
  double Drop(double command, double t_s);
  double Delay(double command, double dt_s);
  double Spread(double command, double dt_s);
  double SumBefore_s(double steps) const;
  void Remember(double value);
  double Past(std::size_t steps) const;

  CommandTimingParameters parameters_;
  Stream drops_;
  std::int64_t step_;
  bool acts_;
  bool held_any_ = false;
  std::int64_t held_message_ = 0;
  double held_ = 0, received_ = 0;
  /// Ring buffer of past commands, or of their time integrals if there is a spread. Initially zero.
  std::vector<double> past_;
  std::size_t newest_ = 0;
  double sum_s_ = 0;
};

}  // namespace tera
