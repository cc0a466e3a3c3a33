#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dataset/import/clocks/motion_series.h"

namespace tera {

/// Difference between the clocks of `channel` and `reference`, from a motion that both observe.
///
/// Model   stamp of `channel` = stamp of `reference` + ahead_s + drift (stamp of `channel` -
///         from_ns). Bounds hold at 95 %. The bound of `ahead_s` allows for stamps up to half an
///         interval off their measurements.
struct ClockDifference {
  std::string channel, reference;
  std::string what, reference_what;  ///< the observed motion in each channel
  TimeNs from_ns = 0;
  double ahead_s = 0, ahead_bound_s = 0;
  double drift = 0, drift_bound = 0;  ///< s/s
  double correlation = 0;
  int stretches = 0;  ///< number of compared stretches of the recording

  /// Whether the difference exceeds its bounds.
  bool IsCertain() const;
};

/// Compares two channels with different clocks.
///
/// Model   selects the pair of series of one kind with the best correlation at any lag within a
///         minute, over ten minutes of the recording. It then fits a straight line through the lags
///         of the pair's stretches, weighted by the sharpness of each.
/// Omits   clocks that jump, and lags beyond a minute. Returns nothing if no pair reaches a
///         correlation of 0.85, or if its peak exceeds that at other lags by less than a sixth, as
///         for different or periodic motions.
std::optional<ClockDifference> CompareClocks(const ChannelMotion& reference,
                                             const ChannelMotion& channel);

/// Compares each clock with the earlier ones in the list, by the best pair of their channels.
/// Returns the certain differences.
std::vector<ClockDifference> ClockDifferences(const std::vector<ChannelMotion>& channels);

}  // namespace tera
