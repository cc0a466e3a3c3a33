#pragma once

#include <optional>
#include <vector>

#include "core/time.h"
#include "dataset/format/measurement_sink.h"

namespace tera {

/// Times of measurement of poses with arrival stamps, ascending, one per pose.
using PoseTimes = std::vector<TimeNs>;

/// Estimates when poses with arrival stamps were measured. Poses from registration, or sent through
/// a network, may queue and then arrive faster than they were measured. With arrival stamps, the
/// machine seems to stand and then jump.
///
/// Model   Poses are measured periodically. The period is the mean of the stamps' intervals that
///         lie within a quarter of their median. Each time is as late as possible: not after its
///         stamp, and at least one period before the next time. The period is shortened by one per
///         cent for its uncertainty.
///         Poses may be lost. A step that is n times as long as its neighbours then covers n
///         periods, if the previous poses had queued long enough. For the length of a step, a turn
///         of one radian counts as a metre.
/// Omits   A latency of all poses (measured_poses.h); losses while the machine stands, accelerates,
///         or moves by less than 2 cm per pose. Also recordings in which more than half of the
///         poses queue: their median interval is that of arrivals.
///
/// `poses` are in the order of their stamps. Returns nothing with fewer than three poses, or if no
/// pose waits longer than two periods. Nearly even stamps thus stay unchanged.
std::optional<PoseTimes> TimesOfArrivals(const std::vector<TruthPose>& poses);

/// The poses with `times_ns` as their stamps.
std::vector<TruthPose> AtTimes(std::vector<TruthPose> poses, const PoseTimes& times_ns);

}  // namespace tera
