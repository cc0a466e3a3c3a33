#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/time.h"
#include "core/types/effects.h"
#include "core/types/learned_effect.h"
#include "diagnose/statistics/regime/regime_axis.h"
#include "diagnose/statistics/series/series.h"

/// The problem that a search for missing physics solves: measured channels, candidate mechanisms
/// that may act on them, and a replay that predicts the channels under any of these. The search
/// knows no machine.

namespace tera {

/// What is as expected of a number: 95 % of it lies within `half_width` of `value`.
struct Expected {
  double value = 0, half_width = 0;
  double neutral = 0;  ///< with which the mechanism has no effect
};

/// One number of a mechanism that a fit may move.
struct FreeParameter {
  std::size_t index = 0;  ///< among the mechanism's parameters
  double lower = 0, upper = 1;
  bool logarithmic = false;  ///< a fit moves it by ratios, not differences
  /// Distance of the kinks and steps that the likelihood has along this number, over its range;
  /// they arise where the number moves instants between samples. 0 where the likelihood is smooth.
  double kink = 0;
  /// It refines another number: an answer has its default, unless it changes the channel enough.
  bool refines = false;
  /// Standard deviation of a normal prior about where a fit begins, which holds what the scans of a
  /// registered sensor (perception/registration) do not tell. 0: there is no prior.
  double prior_sigma = 0;
  std::optional<Expected> expected = {};  ///< none: nothing is stated
};

/// A mechanism that may act on a target, with the ranges of its numbers and starts for their
/// search.
struct Candidate {
  const Mechanism* mechanism = nullptr;
  std::string target;  ///< as in YAML: "boom", "base", "encoders/boom"
  std::vector<FreeParameter> free;
  /// Starts of a fit, at least one: each holds all of the mechanism's numbers, within the bounds of
  /// `free`. They go from faint to strong, so that they serve as a ladder of sizes as well.
  std::vector<std::vector<double>> starts;
  /// The numbers that the model has of the mechanism already; none where it lacks it.
  std::vector<double> present;
  /// Whether with these numbers it is the mechanism of its name, and no other one in disguise.
  /// Empty where it always is.
  std::function<bool(const std::vector<double>& values)> is_itself = {};
};

/// A candidate with values for all of its mechanism's parameters.
struct Term {
  const Candidate* candidate = nullptr;
  std::vector<double> values;
  /// Indices of free parameters that a fit nevertheless leaves as they are.
  std::vector<std::size_t> held = {};

  bool IsItself() const { return !candidate->is_itself || candidate->is_itself(values); }
  bool IsHeld(std::size_t index) const {
    return std::find(held.begin(), held.end(), index) != held.end();
  }
  /// The parameters that a fit moves.
  std::vector<FreeParameter> Free() const {
    std::vector<FreeParameter> free = candidate->free;
    std::erase_if(free, [&](const FreeParameter& one) { return IsHeld(one.index); });
    return free;
  }
};

/// The terms that a prediction assumes to act, each candidate at most once.
using Structure = std::vector<Term>;

/// The structure with one term more.
inline Structure With(Structure terms, const Candidate& candidate,
                      const std::vector<double>& values) {
  terms.push_back({&candidate, values});
  return terms;
}

/// The structure without one of its terms.
inline Structure Without(Structure terms, std::size_t term) {
  terms.erase(terms.begin() + static_cast<std::ptrdiff_t>(term));
  return terms;
}

/// A mechanism with numbers that were read off a measurement: a place where a fit may begin.
struct Reading {
  std::string_view mechanism;
  std::string target;
  std::vector<double> values;  ///< none: as the candidate's first start
  /// Numbers that do what others of the reading do as well, and are held.
  std::vector<std::size_t> held = {};
};

/// Standard deviations of what a channel may be off by without a finding: an offset, a factor on
/// the prediction, and a shift in time.
struct Nuisances {
  double offset = 0;
  double gain = 0.03;
  double delay_s = 0;
};

/// A measured quantity on the block's grid.
struct Channel {
  std::string name;  ///< "excavator1/encoders/boom_radps"
  std::string unit;  ///< "rad/s"
  Series measured;
  Nuisances nuisances;
  /// Variables that its error may depend on, each of the grid's length.
  std::vector<RegimeVariable> variables;
  /// The flexible regressor: columns, one row a sample, whose combinations come near to anything
  /// that the physics of the block could do. May be empty.
  Eigen::MatrixXd flexible_regressor;
  /// Change of the prediction by one standard deviation of each nominal number: one column a
  /// number, one row a sample. They are nuisances beside the three above; may be empty.
  Eigen::MatrixXd nominal;
  /// Samples at which the measurement lags behind by masses that the replay does not have; may be
  /// empty. ExcludeLaggingSamples (excluded_samples.h), which comes before a search, makes them
  /// gaps.
  std::vector<bool> is_lagging = {};
};

using Replay =
    std::function<std::vector<std::vector<double>>(const Structure&, std::size_t samples)>;

/// A replay that predicts all samples, however few are asked for.
inline Replay WholeReplay(
    std::function<std::vector<std::vector<double>>(const Structure&)> predict) {
  return [predict = std::move(predict)](const Structure& terms, std::size_t samples) {
    std::vector<std::vector<double>> channels = predict(terms);
    for (std::vector<double>& channel : channels) channel.resize(samples);
    return channels;
  };
}

/// One part of a machine, replayed alone over the measured motion of its neighbours.
struct ReplayBlock {
  std::string name;
  TimeNs first_ns = 0;  ///< of the grid's first place, from the recording's first sample on
  std::vector<Channel> channels;  ///< at least one, all on one grid
  bool slides = false;  ///< of a joint whose radians are metres and whose newton metres are newtons
  std::vector<Candidate> candidates;
  /// The loss of commands, which no replay can predict (LostCommandsOf); at most one.
  std::vector<Candidate> of_chance = {};
  /// The whole chain from lever to measurement as its first channel's samples in a mask show it,
  /// once for each of several coarse readings; none where nothing is read.
  std::function<std::vector<std::vector<Reading>>(const Channel&, const Mask&)> read_whole = {};
  std::vector<Series> commands;  ///< on the grid; manoeuvres are cut by them
  /// Whether what is left at rest shows the noise: not where the measurements follow from knowing
  /// that the machine stands.
  bool rest_shows_noise = true;
  /// Predicts each channel over the first `samples` of the grid with these terms at work. Each term
  /// takes the place of what the model has of its mechanism; all else that the model has stays.
  /// Thread-safe; the same for the same terms in any order. A shorter prediction is a prefix of a
  /// longer one, except in a gap at its end, across which it has no later sample to interpolate to.
  Replay replay;
  /// What a learned effect of the block's axis may depend on; empty where a simulation can have
  /// none there, or has one already.
  std::vector<LearnedVariable> learnable = {};
  /// By what a learned effect of one of `learnable`, behind these terms, changes the prediction of
  /// each channel over the whole grid.
  std::function<std::vector<std::vector<double>>(const Structure&, const LearnedEffect&)>
      change_by_learned = {};

  /// The prediction over the whole grid.
  std::vector<std::vector<double>> predict(const Structure& terms) const {
    return replay(terms, samples());
  }

  std::size_t samples() const { return channels.front().measured.size(); }
  double period_s() const { return channels.front().measured.period_s; }
  /// Time of a place of the grid in the recording.
  double time_s(std::size_t place) const {
    return ToSeconds(first_ns) + static_cast<double>(place) * period_s();
  }
};

/// Whether a candidate acts by chance, so that no replay predicts it.
inline bool IsOfChance(const ReplayBlock& block, const Candidate& candidate) {
  return std::any_of(block.of_chance.begin(), block.of_chance.end(),
                     [&](const Candidate& one) { return one.mechanism == candidate.mechanism; });
}

/// Whether a lever drives what the block replays, so that the block has mechanisms of command
/// timing.
inline bool HasLever(const ReplayBlock& block) {
  return std::any_of(
      block.candidates.begin(), block.candidates.end(),
      [](const Candidate& candidate) { return candidate.mechanism->slot == Slot::kCommandTiming; });
}

}  // namespace tera
