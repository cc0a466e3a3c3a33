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
/// proxy. A term is a candidate with values. A structure is a set of terms. A gain in likelihood is
/// steady if it recurs over manoeuvres (steady_gain.h).

namespace tera {

/// Expected deviation of a parameter: 95 % of machines have a value within `half_width` of `value`.
struct Expected {
  double value = 0, half_width = 0;
  double neutral = 0;  ///< value without effect
  bool delays_command =
      false;  ///< true if the tolerance is of the sum of all such delays of a target
};

/// A parameter of a mechanism that fits may change.
struct FreeParameter {
  std::size_t index = 0;  ///< index of the parameter in the mechanism
  double lower = 0, upper = 1;
  bool logarithmic = false;  ///< fits change it by ratios, not by differences
  /// Distance between kinks or steps of the likelihood along this parameter, over its range. They
  /// occur where the parameter shifts an event across a sample. 0: the likelihood is smooth.
  double kink = 0;
  /// True if it refines another parameter. It keeps its default unless it changes the channel
  /// enough.
  bool refines = false;
  /// Standard deviation of a normal prior about the starting value. It holds parameters of a
  /// registered sensor that its scans do not determine (perception/registration). 0: no prior.
  double prior_sigma = 0;
  std::optional<Expected> expected = {};  ///< none: no stated tolerance
};

/// A mechanism that may act on a target, with ranges and starting values of its parameters.
struct Candidate {
  const Mechanism* mechanism = nullptr;
  std::string target;  ///< name as in YAML: "boom", "base", "encoders/boom"
  std::vector<FreeParameter> free;
  /// Starting values of fits, at least one set, each with all of the mechanism's parameters, within
  /// the bounds of `free`. They are ordered from faint to strong effects, so that they also serve
  /// as a scale of sizes.
  std::vector<std::vector<double>> starts;
  /// The mechanism's values in the model; empty if the model lacks it.
  std::vector<double> present;
  /// False for values that make the mechanism another one in disguise. Empty: always true.
  std::function<bool(const std::vector<double>& values)> is_itself = {};
};

/// A candidate with values of all its parameters.
struct Term {
  const Candidate* candidate = nullptr;
  std::vector<double> values;
  /// Indices of free parameters that fits hold fixed.
  std::vector<std::size_t> held = {};

  bool IsItself() const { return !candidate->is_itself || candidate->is_itself(values); }
  bool IsHeld(std::size_t index) const {
    return std::find(held.begin(), held.end(), index) != held.end();
  }
  std::vector<FreeParameter> Free() const {
    std::vector<FreeParameter> free = candidate->free;
    std::erase_if(free, [&](const FreeParameter& one) { return IsHeld(one.index); });
    return free;
  }
};

/// A set of terms that act together, each candidate at most once.
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

/// Initial estimate of a mechanism from a measurement.
struct Reading {
  std::string_view mechanism;
  std::string target;
  std::vector<double> values;  ///< empty: the candidate's first start
  /// Indices of parameters held fixed, because others have the same effect.
  std::vector<std::size_t> held = {};
};

/// Standard deviations of a channel's nuisance parameters: an offset, a factor on the prediction,
/// and a time shift. A nuisance parameter is fitted but never reported as a finding.
struct Nuisances {
  double offset = 0;
  double gain = 0.03;
  double delay_s = 0;
};

/// A measured quantity on the block's time grid.
struct Channel {
  std::string name;  ///< "excavator1/encoders/boom_radps"
  std::string unit;  ///< "rad/s"
  Series measured;
  Nuisances nuisances;
  /// Variables on which the error may depend, on the same grid.
  std::vector<RegimeVariable> variables;
  /// The flexible regressor: columns whose combinations approximate anything that the block's
  /// physics could do, one row per sample. May be empty.
  Eigen::MatrixXd flexible_regressor;
  /// Change of the prediction by one standard deviation of each nominal number, one column per
  /// number and one row per sample. They act as further nuisance parameters. May be empty.
  Eigen::MatrixXd nominal;
  /// Samples at which the measurement lags because of inertia that the replay lacks. May be empty.
  /// ExcludeLaggingSamples (excluded_samples.h) turns them into gaps and must precede a search.
  std::vector<bool> is_lagging = {};
};

using Replay =
    std::function<std::vector<std::vector<double>>(const Structure&, std::size_t samples)>;

/// A replay that always predicts the whole grid and returns its first `samples`.
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
  TimeNs first_ns = 0;            ///< start of the grid, since the recording's first sample
  std::vector<Channel> channels;  ///< at least one channel, all on the same grid
  bool slides = false;            ///< true for a prismatic joint: rad reads as m, and N m as N
  std::vector<Candidate> candidates;
  /// Loss of commands, which no replay can predict (LostCommandsOf). At most one.
  std::vector<Candidate> of_chance = {};
  /// Initial estimates of the whole chain from lever to measurement, from the first channel's
  /// samples in a mask. One list per coarse model. Empty if the block has none.
  std::function<std::vector<std::vector<Reading>>(const Channel&, const Mask&)> read_whole = {};
  std::vector<Series> commands;  ///< commands on the grid; they delimit the manoeuvres
  /// True if the residual at rest shows the noise. False if the measurements were estimated with
  /// the knowledge that the machine is at rest.
  bool rest_shows_noise = true;
  /// Predicts each channel over the first `samples` of the grid with these terms. Each term
  /// replaces the model's own values of its mechanism; the rest of the model is unchanged.
  /// Thread-safe, and independent of the order of terms. A shorter prediction is a prefix of a
  /// longer one. Exception: in a gap at its end it lacks the later sample for interpolation.
  Replay replay;
  /// Variables on which a learned effect of the block's axis may depend. Empty if a simulation
  /// cannot have such an effect, or has one already.
  std::vector<LearnedVariable> learnable = {};
  /// Change of each channel's prediction over the whole grid by a learned effect that is added to
  /// these terms.
  std::function<std::vector<std::vector<double>>(const Structure&, const LearnedEffect&)>
      change_by_learned = {};

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

/// True if a candidate acts at random, so that no replay predicts it.
inline bool IsOfChance(const ReplayBlock& block, const Candidate& candidate) {
  return std::any_of(block.of_chance.begin(), block.of_chance.end(),
                     [&](const Candidate& one) { return one.mechanism == candidate.mechanism; });
}

/// True if a lever drives the block.
inline bool HasLever(const ReplayBlock& block) {
  return std::any_of(
      block.candidates.begin(), block.candidates.end(),
      [](const Candidate& candidate) { return candidate.mechanism->slot == Slot::kCommandTiming; });
}

}  // namespace tera
