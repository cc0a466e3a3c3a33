#pragma once

#include <string>
#include <vector>

#include "dataset/compare/trajectory_error.h"

namespace tera {

/// Why two tracks of one body may lie apart although both were measured well, as sentences: `b` is
/// as large as `a` in another unit, its times differ by what GPS time, UTC and TAI differ, or it
/// lies as far away as coordinates of a map do.
///
/// Model   units: the scale of Umeyama's similarity, where it leaves a twentieth of a's size.
/// Times:
///         a shift that leaves less than a third of the error, and less than shifts of a second
///         more or less do.
std::vector<std::string> TrackDoubts(const Trajectory& a, const Trajectory& b, TimeNs max_gap_ns);

}  // namespace tera
