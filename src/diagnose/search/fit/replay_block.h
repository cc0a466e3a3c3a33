#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "core/time.h"
#include "core/types/effects.h"
#include "diagnose/statistics/regime/regime_axis.h"
#include "diagnose/statistics/series/series.h"

/// What a search for left-out physics works on: channels that were measured, mechanisms that may
/// act on them, and a replay that says what the channels would have been. The search knows no
/// machine.

namespace tera {

/// One number of a mechanism that a fit may move.
struct FreeParameter {
  std::size_t index = 0;  ///< among the mechanism's parameters
  double lower = 0, upper = 1;
  bool logarithmic = false;  ///< moved by ratios, not differences
  /// How far apart the likelihood has stairs and kinks, of the range, as where the number moves
  /// instants between which samples say nothing; 0: it is smooth.
  double kink = 0;
  /// It refines another number: in an answer it stands at its default unless it shows.
  bool refines = false;
  /// Of a sensor that is registered (perception/registration): standard deviation of a normal prior
  /// about where a fit begins, which holds what the scans do not tell; 0: none.
  double prior_sigma = 0;
};

/// A mechanism that may act on a target, and where to begin looking for its numbers.
struct Suspect {
  const Mechanism* mechanism = nullptr;
  std::string target;  ///< as in YAML: "boom", "base", "encoders/boom"
  std::vector<FreeParameter> free;
  /// All of the mechanism's numbers, each list within the bounds of `free`; at least one. From
  /// faint to strong, so that they serve as a ladder of sizes as well.
  std::vector<std::vector<double>> starts;
  /// The numbers that the model has of it already; none where it has not.
  std::vector<double> present;
  /// Whether it is what it is called with these numbers, and no other mechanism in disguise; empty:
  /// with all.
  std::function<bool(const std::vector<double>& values)> is_itself = {};
};

/// A suspect with its numbers, all of the mechanism's parameters.
struct Term {
  const Suspect* suspect = nullptr;
  std::vector<double> values;
  /// Of its parameters, those that a fit leaves as they are though the suspect would free them.
  std::vector<std::size_t> held = {};

  bool IsItself() const { return !suspect->is_itself || suspect->is_itself(values); }
  bool IsHeld(std::size_t index) const {
    return std::find(held.begin(), held.end(), index) != held.end();
  }
  /// What a fit moves.
  std::vector<FreeParameter> Free() const {
    std::vector<FreeParameter> free = suspect->free;
    std::erase_if(free, [&](const FreeParameter& one) { return IsHeld(one.index); });
    return free;
  }
};

/// What is taken to act; each suspect once.
using Structure = std::vector<Term>;

/// All terms but one.
inline Structure Without(Structure terms, std::size_t term) {
  terms.erase(terms.begin() + static_cast<std::ptrdiff_t>(term));
  return terms;
}

/// How far a channel may be off for reasons that are no finding: standard deviations of an offset,
/// of a factor on the prediction, of a shift in time.
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
  /// What its error may depend on, each of the grid's length.
  std::vector<RegimeVariable> variables;
  /// Columns, one row a sample, whose combinations come near to anything that the physics of the
  /// block could do: the free member. May be empty.
  Eigen::MatrixXd free_member;
  /// What the prediction changes by where a nominal number is off by its standard deviation: one
  /// column a number, one row a sample. Nuisances beside the three; may be empty.
  Eigen::MatrixXd nominal;
  /// At which samples it lags by masses that the replay does not have; may be empty. They count
  /// until LeaveOutLags (left_out.h), which a search comes after.
  std::vector<bool> lags = {};
};

using Replay =
    std::function<std::vector<std::vector<double>>(const Structure&, std::size_t samples)>;

/// A replay that goes over everything, however little is asked for.
inline Replay WholeReplay(
    std::function<std::vector<std::vector<double>>(const Structure&)> predict) {
  return [predict = std::move(predict)](const Structure& terms, std::size_t samples) {
    std::vector<std::vector<double>> channels = predict(terms);
    for (std::vector<double>& channel : channels) channel.resize(samples);
    return channels;
  };
}

/// One part of the chain, replayed alone over its measured neighbours.
struct ReplayBlock {
  std::string name;
  TimeNs first_ns = 0;            ///< of the grid's first place; from the recording's first sample
  std::vector<Channel> channels;  ///< at least one, all on one grid
  bool slides = false;  ///< of a joint whose radians and newton metres are metres and newtons
  std::vector<Suspect> suspects;
  std::vector<Series> commands;  ///< on the grid: what tells manoeuvres apart
  /// What each channel would have been, over the first `samples` of the grid, were these terms at
  /// work, each in place of what the model has of that mechanism, beside all else that it has.
  /// Thread-safe, the same for the same terms in any order. Fewer samples are a beginning of more,
  /// but that in a gap at their end there is nothing to go towards.
  Replay replay;

  /// Over all of the grid.
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

/// Whether a lever drives what the block replays, which may then follow it late.
inline bool HasLever(const ReplayBlock& block) {
  return std::any_of(block.suspects.begin(), block.suspects.end(), [](const Suspect& suspect) {
    return suspect.mechanism->slot == Slot::kCommandTiming;
  });
}

}  // namespace tera
