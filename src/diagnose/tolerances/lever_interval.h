#pragma once

#include "dataset/format/recording.h"

namespace tera {

/// Interval between rows of a lever log that polls; 0 for a log with a row at each change.
///
/// Model   the median. A log polls if one row in twenty repeats the previous one in all columns.
///         Changes between two rows are unknown, so the time of a change is known to half the
///         interval.
double LeverInterval_s(const TableRecording& levers);

}  // namespace tera
