#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dataset/import/clocks/motion_series.h"

namespace tera {

/// Difference between the clocks of two channels, estimated from a motion that both measure.
///
/// Model   stamp of `channel` = stamp of `reference` + ahead_s + drift (stamp of `channel` -
///         from_ns). Bounds are at 95 %. `ahead_bound_s` includes half a sample interval, because a
///         stamp may deviate that much from its measurement.
struct ClockDifference {
  std::string channel, reference;
  std::string what, reference_what;  ///< motion that was compared, such as a rate about an axis
  TimeNs from_ns = 0;
  double ahead_s = 0, ahead_bound_s = 0;
  double drift = 0, drift_bound = 0;  ///< s/s
  double correlation = 0;
  int stretches = 0;  ///< number of parts of the recording that were compared

  /// True if the difference exceeds its bounds.
  bool IsCertain() const;
};

/// Compares two channels with different clocks.
///
/// Model   Selects two series of one kind, one from each channel, with the highest correlation. The
///         search covers lags of up to a minute, over ten minutes of the recording. A weighted
///         straight line through the lags of short stretches gives offset and drift; the weight of
///         a stretch is the sharpness of its correlation peak.
/// Omits   clocks that jump, and lags beyond a minute. Returns nullopt if no correlation reaches
///         0.85. Also returns nullopt if the peak is less than a sixth higher than correlations at
///         other lags, which happens for unrelated or periodic motions.
std::optional<ClockDifference> CompareClocks(const ChannelMotion& reference,
                                             const ChannelMotion& channel);

/// Compares each clock with the earlier clocks in the list, using the best pair of channels.
/// Returns the differences for which IsCertain is true.
std::vector<ClockDifference> ClockDifferences(const std::vector<ChannelMotion>& channels);

}  // namespace tera
