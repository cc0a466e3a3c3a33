#pragma once

#include <optional>
#include <vector>

#include "core/time.h"
#include "dataset/measurement_sink.h"

namespace tera {

/// When poses were measured that are stamped as they arrive.
struct PoseTimes {
  double period_s = 0;       ///< from one measurement to the next
  std::vector<TimeNs> t_ns;  ///< one for each pose, increasing
};

/// Poses that come from registration, or through a network, may wait, and then come faster than
/// they were measured. A recorder that stamps what arrives has them standing still and jumping.
///
/// Model   measured once a period, the median of what their stamps are apart; each as late as may
///         be, but before its stamp and a period before the next one. One that moved a whole number
///         of times as far as its neighbours on both sides came after as many periods: those in
///         between were lost. A turn by a radian counts as a metre.
/// Omits   what all of them are late by (`latency`, measured_poses.h); losses while the machine
///         stands, or where it gains speed.
///
/// Nothing where no pose waits for longer than a period, so that evenly stamped ones stay as they
/// are, or there are fewer than three. Poses are in the order of their stamps.
std::optional<PoseTimes> TimesOfArrivals(const std::vector<TruthPose>& poses);

/// The same poses at these times.
std::vector<TruthPose> AtTimes(std::vector<TruthPose> poses, const PoseTimes& times);

}  // namespace tera
