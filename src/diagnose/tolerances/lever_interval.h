#pragma once

#include "dataset/format/recording.h"

namespace tera {

/// Interval between rows of a lever log that polls. 0 for a log that writes a row at each change.
///
/// Model   the median interval. A log polls if at least one row in twenty repeats the previous one
///         in all columns. The time of a change between two rows is known to half the interval.
double LeverInterval_s(const TableRecording& levers);

}  // namespace tera
