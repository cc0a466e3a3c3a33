#include "physics/actuation/command_timing.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"

namespace tera {
namespace {

/// Greatest step rate, which determines the size of the ring buffer.
constexpr double kFastest_hz = 5000;
/// Tolerance against rounding, in messages: a message due at the start of a step belongs to this
/// step.
constexpr double kRounding = 1e-9;

std::int64_t MessageAt(double t_s, double period_s, double phase) {
  return static_cast<std::int64_t>(std::floor(t_s / period_s - phase + kRounding));
}

}  // namespace

CommandTimingParameters CommandTimingOf(const Effects& effects) {
  CommandTimingParameters parameters;
  if (const Effect* hold = FindEffect(effects, "input_hold")) {
    parameters.hold_period_s = (*hold)["period_s"];
    parameters.hold_phase = (*hold)["phase"];
  }
  if (const Effect* drops = FindEffect(effects, "command_drops")) {
    parameters.drop_period_s = (*drops)["period_s"];
    parameters.drop_probability = (*drops)["probability"];
  }
  if (const Effect* delay = FindEffect(effects, "command_delay")) {
    parameters.delay_s = (*delay)["delay_s"];
    parameters.delay_spread_s = (*delay)["spread_s"];
  }
  return parameters;
}

CommandTiming::CommandTiming(const CommandTimingParameters& parameters, const Stream& drops,
                             std::int64_t first_step)
    : parameters_(parameters),
      drops_(drops),
      step_(first_step),
      acts_(parameters.hold_period_s > 0 || parameters.drop_probability > 0 ||
            parameters.delay_s > 0) {
  if (parameters.delay_s <= 0) return;
  const double longest_s = (parameters.delay_spread_s > 0 ? 2 : 1) * parameters.delay_s;
  past_.assign(static_cast<std::size_t>(std::ceil(longest_s * kFastest_hz)) + 3, 0.0);
}

double CommandTiming::Act(double command, double dt_s) {
  const double t_s = static_cast<double>(step_++) * dt_s;
  if (parameters_.hold_period_s > 0) command = Hold(command, t_s);
  if (parameters_.drop_probability > 0) command = Drop(command, t_s);
  if (parameters_.delay_s > 0) {
    command = parameters_.delay_spread_s > 0 ? Spread(command, dt_s) : Delay(command, dt_s);
  }
  return command;
}

double CommandTiming::Hold(double command, double t_s) {
  const std::int64_t message = MessageAt(t_s, parameters_.hold_period_s, parameters_.hold_phase);
  if (!held_any_ || message != held_message_) held_ = command;
  held_any_ = true;
  held_message_ = message;
  return held_;
}

double CommandTiming::Drop(double command, double t_s) {
  const std::int64_t message = MessageAt(t_s, parameters_.drop_period_s, 0);
  const bool lost =
      drops_.Uniform(static_cast<std::uint64_t>(message)) < parameters_.drop_probability;
  if (!lost) received_ = command;
  return received_;
}

double CommandTiming::Delay(double command, double dt_s) {
  const double steps = parameters_.delay_s / dt_s;
  const auto whole = static_cast<std::size_t>(steps);
  TERA_CHECK(whole + 2 <= past_.size(), dt_s, parameters_.delay_s);
  Remember(command);
  const double fraction = steps - static_cast<double>(whole);
  return (1 - fraction) * Past(whole) + fraction * Past(whole + 1);
}

double CommandTiming::Spread(double command, double dt_s) {
  // Width of one uniform distribution with the variance of the delays and of a step together. The
  // bound keeps commands from acting early.
  const double width_s = std::min(
      std::sqrt(12 * parameters_.delay_spread_s * parameters_.delay_spread_s + dt_s * dt_s),
      2 * parameters_.delay_s + dt_s);
  const double middle_s = parameters_.delay_s + 0.5 * dt_s;
  sum_s_ += command * dt_s;
  Remember(sum_s_);
  return (SumBefore_s((middle_s - 0.5 * width_s) / dt_s) -
          SumBefore_s((middle_s + 0.5 * width_s) / dt_s)) /
         width_s;
}

void CommandTiming::Remember(double value) {
  newest_ = newest_ + 1 == past_.size() ? 0 : newest_ + 1;
  past_[newest_] = value;
}

/// The value stored `steps` steps before the newest one. `steps` must be less than the size of the
/// ring buffer.
double CommandTiming::Past(std::size_t steps) const {
  return past_[steps <= newest_ ? newest_ - steps : newest_ + past_.size() - steps];
}

/// Time integral of the commands up to `steps` steps before the end of the newest one.
double CommandTiming::SumBefore_s(double steps) const {
  const auto whole = static_cast<std::size_t>(std::max(0.0, steps));
  TERA_CHECK(whole + 2 <= past_.size(), steps, parameters_.delay_s);
  return std::lerp(Past(whole), Past(whole + 1), steps - static_cast<double>(whole));
}

}  // namespace tera
