#pragma once

#include <string>
#include <vector>

#include "dataset/compare/trajectory_error.h"

namespace tera {

/// Tests whether two tracks of one body differ by a convention instead of the measurement. `b` may
/// use another unit of length, another time scale (GPS time, UTC, TAI) or map coordinates. Returns
/// a sentence for each suspected cause.
///
/// Model   Unit: the scale of Umeyama's similarity, if its residual is below a twentieth of the
///         size of a. Time scale: a shift between GPS time, UTC and TAI, if it reduces the error to
///         less than a third. Shifts that are one second longer or shorter must leave a larger
///         error.
std::vector<std::string> TrackDoubts(const Trajectory& a, const Trajectory& b, TimeNs max_gap_ns);

}  // namespace tera
