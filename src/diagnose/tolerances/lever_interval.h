#pragma once

#include "dataset/format/recording.h"

namespace tera {

/// The time from row to row of levers that a logger asks for again and again; 0 where rows come
/// with changes alone.
///
/// Model   the median; rows are asked for where one in twenty repeats the one before in all
///         columns. What a lever did between two rows nobody knows: a change is known to half the
///         interval.
double LeverInterval_s(const TableRecording& levers);

}  // namespace tera
