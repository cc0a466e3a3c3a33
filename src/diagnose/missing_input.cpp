#include "diagnose/missing_input.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "diagnose/statistics/series/robust.h"
#include "physics/actuation/axes.h"

namespace tera {
namespace {

constexpr double kNeutral = 0.02;  ///< a lever below this rests: the expected dead band
/// Longest effect of a lever on the rate after its return to neutral.
constexpr double kLongestEffect_s = 2;
constexpr double kMovingShare = 0.2;   ///< limit of a moving rate, over the axis's larger rates
constexpr double kLargerRates = 0.95;  ///< quantile that represents the larger rates
constexpr double kNoiseSigmas = 6;
constexpr double kShake_s = 1;  ///< longest period of a machine's shaking
constexpr double kMostShare = 0.2, kLeast_s = 2;
constexpr double kLongestPeriod_s = 1;  ///< longest time that one sample covers after lost samples

/// The kLargerRates quantile; 0 without values.
double LargerOf(std::vector<double> size) {
  if (size.empty()) return 0;
  const auto larger = size.begin() + static_cast<std::ptrdiff_t>(
                                         kLargerRates * static_cast<double>(size.size() - 1));
  std::nth_element(size.begin(), larger, size.end());
  return *larger;
}

/// Positions of one lever over the steps of a log.
struct LeverSteps {
  std::vector<std::size_t> rests_for;  ///< steps since the lever was last out of neutral
  double low = 0, high = 0;
};

LeverSteps StepsOf(const AxisLog& log, std::size_t axis) {
  LeverSteps steps;
  std::size_t rests = static_cast<std::size_t>(kLongestEffect_s / log.step_s);
  for (std::size_t k = 0; k < log.steps; ++k) {
    const double lever = log.levers_at(k)[axis];
    steps.low = std::min(steps.low, lever);
    steps.high = std::max(steps.high, lever);
    rests = std::abs(lever) > kNeutral ? 0 : rests + 1;
    steps.rests_for.push_back(rests);
  }
  return steps;
}

/// Rate above which an axis moves, from its rates overall, its rates under its lever, and its
/// noise.
double MovingRate(const MeasuredRate& measured, const LeverSteps& lever, std::size_t long_rest) {
  const std::vector<double>& rate = measured.rate_radps;
  std::vector<double> size, pushed, third;
  for (std::size_t k = 0; k < rate.size(); ++k) {
    size.push_back(std::abs(rate[k]));
    const auto step = static_cast<std::size_t>(std::max(0.0, measured.at_step[k]));
    const bool acts = step < lever.rests_for.size() && lever.rests_for[step] < long_rest;
    if (acts) pushed.push_back(size.back());
    if (k >= 3) third.push_back(rate[k] - 3 * rate[k - 1] + 3 * rate[k - 2] - rate[k - 3]);
  }
  const double noise = third.empty() ? 0 : RobustScale(third) / std::sqrt(20.0);
  const double larger = std::max(LargerOf(std::move(size)), LargerOf(std::move(pushed)));
  return std::max(kMovingShare * larger, kNoiseSigmas * noise);
}

/// Magnitude of the mean rate over kShake_s before or after each sample, whichever is larger.
std::vector<double> SizesWithoutShakes(const MeasuredRate& measured, double step_s) {
  const std::vector<double>& at = measured.at_step;
  std::vector<double> sums = {0};
  for (const double rate : measured.rate_radps) sums.push_back(sums.back() + rate);
  const auto mean = [&](std::size_t first, std::size_t end) {
    return std::abs(sums[end] - sums[first]) / static_cast<double>(end - first);
  };
  std::vector<double> sizes;
  std::size_t before = 0, after = 0;
  for (std::size_t k = 0; k < at.size(); ++k) {
    while (at[before] < at[k] - kShake_s / step_s) ++before;
    while (after < at.size() && at[after] <= at[k] + kShake_s / step_s) ++after;
    sizes.push_back(std::max(mean(before, k + 1), mean(k, after)));
  }
  return sizes;
}

/// Durations of an axis's motion: in total, while its lever rests, and in each direction.
struct MovingTime {
  double all_s = 0, resting_s = 0, forwards_s = 0, backwards_s = 0;
  double rate_by_lever = 0;  ///< sum of rate times lever; positive if the axis follows its lever
};

/// Rates of the same channel in a simulation; null without one.
const std::vector<double>* RatesOf(const AxisLog* simulated, const MeasuredRate& measured) {
  if (simulated == nullptr) return nullptr;
  for (const MeasuredRate& one : simulated->measured) {
    if (one.axis == measured.axis && one.channel == measured.channel) return &one.rate_radps;
  }
  return nullptr;
}

MovingTime MovingTimeOf(const AxisLog& log, const MeasuredRate& measured, const LeverSteps& lever,
                        const std::vector<double>* simulated_radps) {
  const auto long_rest = static_cast<std::size_t>(kLongestEffect_s / log.step_s);
  const double moving_rate = MovingRate(measured, lever, long_rest);
  const std::vector<double> steady_radps = SizesWithoutShakes(measured, log.step_s);
  const auto moves_too = [&](std::size_t k, double rate) {
    return simulated_radps != nullptr && k < simulated_radps->size() &&
           (*simulated_radps)[k] * (rate > 0 ? 1 : -1) > moving_rate;
  };
  MovingTime time;
  for (std::size_t k = 1; k < measured.rate_radps.size(); ++k) {
    const double rate = measured.rate_radps[k], at = measured.at_step[k];
    if (std::abs(rate) <= moving_rate || at < 0 || at >= static_cast<double>(log.steps)) continue;
    const auto step = static_cast<std::size_t>(at);
    const double period_s = std::min((at - measured.at_step[k - 1]) * log.step_s, kLongestPeriod_s);
    time.all_s += period_s;
    const bool travels = steady_radps[k] > moving_rate;
    const bool rests = lever.rests_for[step] >= long_rest;
    if (rests && travels && !moves_too(k, rate)) time.resting_s += period_s;
    (rate > 0 ? time.forwards_s : time.backwards_s) += period_s;
    time.rate_by_lever += rate * log.levers_at(step)[measured.axis];
  }
  return time;
}

std::optional<MissingInput> MissingOf(const AxisLog& log, const MeasuredRate& measured,
                                      const std::vector<double>* simulated_radps) {
  if (measured.rate_radps.size() < 4 || log.steps == 0) return std::nullopt;
  const LeverSteps lever = StepsOf(log, measured.axis);
  const MovingTime time = MovingTimeOf(log, measured, lever, simulated_radps);
  const double least_s = std::max(kLeast_s, kMostShare * time.all_s);
  const bool to_one_side = (lever.low >= -kNeutral) != (lever.high <= kNeutral);
  const bool follows_forwards = (time.rate_by_lever > 0) == (lever.high > kNeutral);
  const double against_s = follows_forwards ? time.backwards_s : time.forwards_s;
  if (to_one_side && against_s > least_s) {
    return MissingInput{measured.channel, {}, against_s / time.all_s, true};
  }
  if (time.resting_s <= least_s) return std::nullopt;
  return MissingInput{measured.channel, {}, time.resting_s / time.all_s, false};
}

}  // namespace

std::vector<MissingInput> FindMissingInput(const MachineModel& model, const AxisLog& log,
                                           const AxisLog* simulated) {
  std::vector<MissingInput> all;
  for (const MeasuredRate& measured : log.measured) {
    if (!HasLever(model, measured.axis)) continue;
    auto missing = MissingOf(log, measured, RatesOf(simulated, measured));
    if (!missing) continue;
    missing->axis = NameOfAxis(model, measured.axis);
    all.push_back(std::move(*missing));
  }
  return all;
}

}  // namespace tera
