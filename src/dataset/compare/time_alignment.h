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

/// Nothing where no channel has a row.
std::optional<RecordedSpan> SpanOf(const Recording& recording);

/// How the times of one recording lie to those of another.
struct TimeAlignment {
  TimeNs shift_ns = 0;  ///< t of the one = t of the other + shift
  bool by_epochs = false;
  /// By what times are compared, or why they may not be of the same event; empty of two simulations
  /// without an epoch, whose times count from their start.
  std::string told;
};

/// Lays the times of `other` beside those of `one`.
///
/// Model   where both have an epoch, by it, unless the recordings then have no time in common, as
///         two drives of different days; else each from its own zero.
TimeAlignment AlignTimes(const Recording& one, const Recording& other);

/// The time that two recordings share, in times of `one`; nothing where there is none or their
/// epochs do not tell.
std::optional<RecordedSpan> TimeInCommon(const Recording& one, const Recording& other);

}  // namespace tera
