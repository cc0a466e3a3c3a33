#pragma once

#include <optional>
#include <string>

#include "core/time.h"
#include "dataset/format/recording.h"

namespace tera {

/// Time of the first and the last row or frame of a recording.
struct RecordedSpan {
  TimeNs first_ns = 0, last_ns = 0;
};

/// Returns nullopt if no channel has a row.
std::optional<RecordedSpan> SpanOf(const Recording& recording);

/// Offset between the times of two recordings.
struct TimeAlignment {
  TimeNs shift_ns = 0;  ///< time of `one` = time of `other` + shift
  bool by_epochs = false;
  /// Explains how times are aligned, or why the recordings may not show the same event. Empty for
  /// two simulations without an epoch, whose times both start at 0.
  std::string told;
};

/// Aligns the times of `other` to those of `one`.
///
/// Model   Epochs align the times if both recordings have an epoch and then overlap in time.
///         Otherwise, for example for drives on different days, time 0 of one recording is aligned
///         with time 0 of the other.
TimeAlignment AlignTimes(const Recording& one, const Recording& other);

/// Common time span in the time of `one`. Returns nullopt if there is none or if the epochs are
/// indeterminate.
std::optional<RecordedSpan> TimeInCommon(const Recording& one, const Recording& other);

}  // namespace tera
