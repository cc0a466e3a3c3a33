#pragma once

#include <cstdint>
#include <vector>

#include "core/random.h"
#include "core/types/effects.h"

namespace tera {

/// What happens to a command between the lever and the valve. As built, nothing.
struct CommandTimingParameters {
  double hold_period_s = 0;  ///< 0: looked at in every step
  double hold_phase = 0;     ///< of the period, when the first message is taken after t = 0
  double drop_period_s = 0;  ///< one message each; 0: none can be lost
  double drop_probability = 0;
  double delay_s = 0;
  double delay_spread_s = 0;  ///< standard deviation of the parts of a command about its delay
};

CommandTimingParameters CommandTimingOf(const Effects& effects);

/// Slot `command_timing` of one lever: sampled by the sender, lost on the way, late.
///
/// Model   input_hold: the command at t = (k + phase) P stands until the next such time; before the
///         first one, the first command of all, for the sender has looked before.
///         command_drops: of the messages k P .. (k + 1) P each is lost with one probability,
///         whatever the others; the last command before it stands meanwhile. command_delay:
///         y(t) = u(t - d), where u is held over each step and y its mean over a step, so that
///         what the command sums to is exact for any d. With a spread s, the mean over all delays
///         from d - w / 2 to d + w / 2 alike, w = sqrt(12) s but at most 2 d, so that nothing acts
///         before it is given; box and step together are one box of their variance, taken at the
///         middle of each step.
/// Omits   jitter of the delay, reordered messages; what the edge of a spread delay's box does
///         within a step, dt^2 / (8 w) of what the command sums to.
class CommandTiming {
 public:
  /// `drops` decides which messages are lost. Time is `first_step` steps at the first one.
  CommandTiming(const CommandTimingParameters& parameters, const Stream& drops,
                std::int64_t first_step);

  /// The command at the valve during a step of `dt_s`, the same in every step, in which `command`
  /// is given.
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
  /// Ring of commands, all neutral before the first; of their sums over time, if spread.
  std::vector<double> past_;
  std::size_t newest_ = 0;
  double sum_s_ = 0;
};

}  // namespace tera
