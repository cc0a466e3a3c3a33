#pragma once

#include <optional>
#include <string>

#include "core/time.h"
#include "dataset/format/recording.h"

namespace tera {

/// From the first to the last row or frame of a recording, in its own times.
struct RecordedSpan {
  TimeNs first_ns = 0, last_ns = 0;
};

/// Returns nothing if no channel has a row.
std::optional<RecordedSpan> SpanOf(const Recording& recording);

/// Relation between the times of two recordings.
struct TimeAlignment {
  TimeNs shift_ns = 0;  ///< t of the one = t of the other + shift
  bool by_epochs = false;
  /// Basis of the alignment, or the reason why the recordings may not show the same event. Empty
  /// for two simulations without an epoch, whose times start at zero.
  std::string told;
};

/// Aligns the times of `other` with those of `one`.
///
/// Model   by their epochs if both have one, unless the recordings then have no common time, as two
///         drives on different days; else each from its own zero.
TimeAlignment AlignTimes(const Recording& one, const Recording& other);

/// The common time of two recordings, in times of `one`; nothing without a common time or with
/// indeterminate epochs.
std::optional<RecordedSpan> TimeInCommon(const Recording& one, const Recording& other);

}  // namespace tera
