#pragma once

#include <optional>
#include <vector>

#include "core/time.h"
#include "dataset/format/measurement_sink.h"

namespace tera {

/// The times at which poses were measured that are stamped as they arrive: one for each pose,
/// rising.
using PoseTimes = std::vector<TimeNs>;

/// Estimates when poses were measured that are stamped as they arrive. Poses from registration, or
/// through a network, may wait and then arrive faster than they were measured; by a recorder's
/// stamps the machine then stands and jumps.
///
/// Model   poses are measured once a period, the mean of those distances of stamps that are within
///         a quarter of their median. Each is as late as possible, but not after its stamp, and a
///         period (less one per cent, by which the period is not known) before the next one. Where
///         the machine moved a whole number of times as far as in the steps on both sides, that
///         many periods passed, since the poses in between were lost, if the poses before it waited
///         for long enough. A turn by a radian counts as a metre.
/// Omits   a latency of all poses (measured_poses.h); losses while the machine stands, accelerates,
///         or moves by less than 2 cm from pose to pose; that more than half of the poses wait,
///         when the median is that of their arrival.
///
/// None where no pose waits for longer than two periods, so that evenly stamped ones stay as they
/// are, or where there are fewer than three. Poses are in the order of their stamps.
std::optional<PoseTimes> TimesOfArrivals(const std::vector<TruthPose>& poses);

/// The poses with these times as their stamps.
std::vector<TruthPose> AtTimes(std::vector<TruthPose> poses, const PoseTimes& times_ns);

}  // namespace tera
