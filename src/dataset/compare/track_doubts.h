#pragma once

#include <string>
#include <vector>

#include "dataset/compare/trajectory_error.h"

namespace tera {

/// Sentences on causes, other than the measurement, of a difference between two tracks of one body.
/// `b` may have the size of `a` in another unit. Its times may differ as GPS time, UTC and TAI do.
/// Its coordinates may be those of a map.
///
/// Model   units: the scale of Umeyama's similarity, if the residual is below a twentieth of a's
///         size. Times: a shift between GPS time, UTC and TAI that leaves less than a third of the
///         unshifted error, and less error than shifts one second longer or shorter.
std::vector<std::string> TrackDoubts(const Trajectory& a, const Trajectory& b, TimeNs max_gap_ns);

}  // namespace tera
