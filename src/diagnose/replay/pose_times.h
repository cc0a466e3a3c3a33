#pragma once

#include <optional>
#include <vector>

#include "core/time.h"
#include "dataset/format/measurement_sink.h"

namespace tera {

/// Times of measurement of poses with arrival stamps: one for each pose, ascending.
using PoseTimes = std::vector<TimeNs>;

/// Estimates the times of measurement of poses with arrival stamps. Poses from registration, or
/// through a network, may wait and then arrive faster than they were measured. By a recorder's
/// stamps the machine then stands and jumps.
///
/// Model   poses are measured once a period, the mean of the stamps' intervals within a quarter of
///         their median. Each time is as late as possible: not after its stamp, and a period before
///         the next one, less one per cent for the period's uncertainty. A displacement of a whole
///         multiple of those in the neighbouring steps means as many periods, with lost poses
///         between, if the previous poses waited long enough. A turn by a radian counts as a metre.
/// Omits   a latency of all poses (measured_poses.h); losses while the machine stands, accelerates,
///         or moves by less than 2 cm from pose to pose. Recordings in which more than half of the
///         poses wait: the median is then that of arrivals.
///
/// None if no pose waits for longer than two periods, so that even stamps stay unchanged, or if
/// there are fewer than three poses. Poses are in the order of their stamps.
std::optional<PoseTimes> TimesOfArrivals(const std::vector<TruthPose>& poses);

/// The poses with these times as their stamps.
std::vector<TruthPose> AtTimes(std::vector<TruthPose> poses, const PoseTimes& times_ns);

}  // namespace tera
