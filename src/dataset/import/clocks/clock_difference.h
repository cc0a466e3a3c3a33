#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dataset/import/clocks/motion_series.h"

namespace tera {

/// How the clock of `channel` differs from that of `reference`, by a motion that both have seen.
///
/// Model   stamp of `channel` = stamp of `reference` + ahead_s + drift (stamp of `channel` -
///         from_ns). Bounds hold 19 times in 20, that of `ahead_s` for stamps that are up to half
///         an interval beside what they measured.
struct ClockDifference {
  std::string channel, reference;
  std::string what, reference_what;  ///< the motion as each tells it
  TimeNs from_ns = 0;
  double ahead_s = 0, ahead_bound_s = 0;
  double drift = 0, drift_bound = 0;  ///< s/s
  double correlation = 0;
  int stretches = 0;  ///< of the recording that were compared

  /// Whether the clocks differ by more than the bounds.
  bool IsCertain() const;
};

/// Compares two channels that do not have one clock.
///
/// Model   of all pairs of series of one kind the one that correlates best at any lag within a
///         minute, by ten minutes of the recording; then the lag of each of its stretches, and a
///         straight line through them, weighted by how sharply each tells it.
/// Omits   clocks that jump, and lags beyond a minute. Says nothing where no pair correlates by
/// 0.85
///         and by a sixth more than at any other lag: motions that are others, or repeat.
std::optional<ClockDifference> CompareClocks(const ChannelMotion& reference,
                                             const ChannelMotion& channel);

/// Each clock, by the channels that have it, against those of the clocks before it in the list, by
/// the two channels that agree best; those that differ with certainty.
std::vector<ClockDifference> ClockDifferences(const std::vector<ChannelMotion>& channels);

}  // namespace tera
