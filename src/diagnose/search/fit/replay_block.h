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

/// The problem that a search for missing physics solves: measured channels, candidate mechanisms,
/// and a replay that predicts the channels under any of them. The search knows no machine.
///
/// docs/guide/glossary.md defines block, manoeuvre, TRAIN, SELECT, FINAL, nuisance, rival and
/// proxy. A term is a candidate with values, a structure a set of terms. A steady gain is a gain in
/// likelihood that recurs over manoeuvres (steady_gain.h).

namespace tera {

/// Expected deviation of a parameter: 95 % of it lies within `half_width` of `value`.
struct Expected {
  double value = 0, half_width = 0;
  double neutral = 0;           ///< value at which the mechanism has no effect
  bool delays_command = false;  ///< the tolerance is of the sum of all such delays of a target
};

/// A parameter of a mechanism that a fit may change.
struct FreeParameter {
  std::size_t index = 0;  ///< among the mechanism's parameters
  double lower = 0, upper = 1;
  bool logarithmic = false;  ///< a fit changes it by ratios, not differences
  /// Distance of the likelihood's kinks and steps along this parameter, over its range. They arise
  /// where the parameter shifts instants between samples. 0: the likelihood is smooth.
  double kink = 0;
  /// It refines another parameter, and keeps its default unless it changes the channel enough.
  bool refines = false;
  /// Standard deviation of a normal prior about the fit's starting value. The prior holds
  /// parameters that scans of a registered sensor (perception/registration) do not determine. 0: no
  /// prior.
  double prior_sigma = 0;
  std::optional<Expected> expected = {};  ///< none: no tolerance is stated
};

/// A mechanism that may act on a target, with its parameters' ranges and starting values.
struct Candidate {
  const Mechanism* mechanism = nullptr;
  std::string target;  ///< as in YAML: "boom", "base", "encoders/boom"
  std::vector<FreeParameter> free;
  /// Starting values of a fit, at least one set. Each has all of the mechanism's parameters, within
  /// the bounds of `free`. They go from faint to strong and thus also serve as a ladder of sizes.
  std::vector<std::vector<double>> starts;
  /// The model's present values of the mechanism; empty if the model lacks it.
  std::vector<double> present;
  /// Whether the mechanism with these values deserves its name, and is not another one in disguise.
  /// Empty: it always does.
  std::function<bool(const std::vector<double>& values)> is_itself = {};
};

/// A candidate with values of all its mechanism's parameters.
struct Term {
  const Candidate* candidate = nullptr;
  std::vector<double> values;
  /// Indices of free parameters that a fit holds fixed.
  std::vector<std::size_t> held = {};

  bool IsItself() const { return !candidate->is_itself || candidate->is_itself(values); }
  bool IsHeld(std::size_t index) const {
    return std::find(held.begin(), held.end(), index) != held.end();
  }
  /// The parameters that a fit changes.
  std::vector<FreeParameter> Free() const {
    std::vector<FreeParameter> free = candidate->free;
    std::erase_if(free, [&](const FreeParameter& one) { return IsHeld(one.index); });
    return free;
  }
};

/// The terms that a prediction assumes to act, each candidate at most once.
using Structure = std::vector<Term>;

inline Structure With(Structure terms, const Candidate& candidate,
                      const std::vector<double>& values) {
  terms.push_back({&candidate, values});
  return terms;
}

inline Structure Without(Structure terms, std::size_t term) {
  terms.erase(terms.begin() + static_cast<std::ptrdiff_t>(term));
  return terms;
}

/// Initial estimate of a mechanism, read off a measurement.
struct Reading {
  std::string_view mechanism;
  std::string target;
  std::vector<double> values;  ///< empty: as the candidate's first start
  /// Indices of parameters held fixed, since others of the reading have the same effect.
  std::vector<std::size_t> held = {};
};

/// Standard deviations of a channel's nuisances, which are no findings: an offset, a factor on the
/// prediction, and a time shift.
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
  /// Variables that the error may depend on, of the grid's length.
  std::vector<RegimeVariable> variables;
  /// The flexible regressor: columns, with a row for each sample, whose combinations approximate
  /// anything that the block's physics could do. May be empty.
  Eigen::MatrixXd flexible_regressor;
  /// Change of the prediction by one standard deviation of each nominal number: a column for each
  /// number, a row for each sample. Further nuisances; may be empty.
  Eigen::MatrixXd nominal;
  /// Samples at which the measurement lags behind by inertia that the replay lacks; may be empty.
  /// ExcludeLaggingSamples (excluded_samples.h) turns them into gaps and must precede a search.
  std::vector<bool> is_lagging = {};
};

using Replay =
    std::function<std::vector<std::vector<double>>(const Structure&, std::size_t samples)>;

/// A replay that always predicts the whole grid and returns the first `samples`.
inline Replay WholeReplay(
    std::function<std::vector<std::vector<double>>(const Structure&)> predict) {
  return [predict = std::move(predict)](const Structure& terms, std::size_t samples) {
    std::vector<std::vector<double>> channels = predict(terms);
    for (std::vector<double>& channel : channels) channel.resize(samples);
    return channels;
  };
}

/// A part of a machine, replayed alone with the measured motion of its neighbours.
struct ReplayBlock {
  std::string name;
  TimeNs first_ns = 0;            ///< start of the grid, relative to the recording's first sample
  std::vector<Channel> channels;  ///< at least one, all on the same grid
  bool slides = false;  ///< a prismatic joint's: radians are metres, and newton metres newtons
  std::vector<Candidate> candidates;
  /// The loss of commands, which no replay can predict (LostCommandsOf); at most one.
  std::vector<Candidate> of_chance = {};
  /// Initial estimates of the whole chain from lever to measurement, from the first channel's
  /// samples in a mask: a list for each of several coarse models. Empty if the block has none.
  std::function<std::vector<std::vector<Reading>>(const Channel&, const Mask&)> read_whole = {};
  std::vector<Series> commands;  ///< on the grid; they separate the manoeuvres
  /// Whether the residual at rest shows the noise. False if the measurements are derived from the
  /// knowledge that the machine stands.
  bool rest_shows_noise = true;
  /// Predicts each channel over the first `samples` of the grid with these terms. Each term
  /// replaces the model's own values of its mechanism; the rest of the model is unchanged.
  /// Thread-safe, and independent of the terms' order. A shorter prediction is a prefix of a longer
  /// one, except in a gap at its end, where it lacks the later sample for interpolation.
  Replay replay;
  /// Variables of a learned effect of the block's axis. Empty if a simulation cannot have such an
  /// effect, or already has.
  std::vector<LearnedVariable> learnable = {};
  /// Change of each channel's prediction over the whole grid by a learned effect of one of
  /// `learnable`, added to these terms.
  std::function<std::vector<std::vector<double>>(const Structure&, const LearnedEffect&)>
      change_by_learned = {};

  /// The prediction over the whole grid.
  std::vector<std::vector<double>> predict(const Structure& terms) const {
    return replay(terms, samples());
  }

  std::size_t samples() const { return channels.front().measured.size(); }
  double period_s() const { return channels.front().measured.period_s; }
  /// Time of a grid sample in the recording.
  double time_s(std::size_t place) const {
    return ToSeconds(first_ns) + static_cast<double>(place) * period_s();
  }
};

/// Whether a candidate acts at random, so that no replay predicts it.
inline bool IsOfChance(const ReplayBlock& block, const Candidate& candidate) {
  return std::any_of(block.of_chance.begin(), block.of_chance.end(),
                     [&](const Candidate& one) { return one.mechanism == candidate.mechanism; });
}

/// Whether a lever drives the block, which then has mechanisms of command timing.
inline bool HasLever(const ReplayBlock& block) {
  return std::any_of(
      block.candidates.begin(), block.candidates.end(),
      [](const Candidate& candidate) { return candidate.mechanism->slot == Slot::kCommandTiming; });
}

}  // namespace tera
