#pragma once

#include <optional>
#include <vector>

#include "core/time.h"
#include "dataset/format/measurement_sink.h"

namespace tera {

/// When poses were measured that are stamped as they arrive: one for each pose, increasing.
using PoseTimes = std::vector<TimeNs>;

/// Poses that come from registration, or through a network, may wait, and then come faster than
/// they were measured. A recorder that stamps what arrives has them standing still and jumping.
///
/// Model   measured once a period, which is the mean of those distances of stamps that are within a
///         quarter of their median; each as late as may be, but at its stamp at the latest and a
///         period, less one per cent for what the period is not known by, before the next one. One
///         that moved a whole number of times as far as its neighbours on both sides came after as
///         many periods, since those in between were lost, if the poses before it waited for long
///         enough. A turn by a radian counts as a metre.
/// Omits   what all of them are late by (`latency`, measured_poses.h); losses while the machine
///         stands, gains speed, or moves by less than 2 cm from pose to pose; that more than half
///         of the poses wait, when the median is that of their coming.
///
/// Nothing where no pose waits for longer than two periods, so that evenly stamped ones stay as
/// they are, or there are fewer than three. Poses are in the order of their stamps.
std::optional<PoseTimes> TimesOfArrivals(const std::vector<TruthPose>& poses);

/// The same poses at these times.
std::vector<TruthPose> AtTimes(std::vector<TruthPose> poses, const PoseTimes& times_ns);

}  // namespace tera
