#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/time.h"

namespace tera {

/// The times at which all that is in view is annotated: the first frame of a sensor, and then the
/// first that is `period_ns` later than the one before, but for a millisecond of jitter.
std::vector<TimeNs> SampleTimes(const std::vector<TimeNs>& frames_ns, TimeNs period_ns);

/// Of each frame the sample that it belongs to, and whether it is that sample's key frame.
struct FrameOfSample {
  std::size_t sample = 0;
  bool is_key = false;
};

/// Model   a frame is a sample's key frame where each is the other's nearest and they are at most
///         `most_apart_ns` apart, so that no sample has two of a sensor, and no frame two samples.
///         Any other frame belongs to the sample that follows it, behind the last one to the last.
///         Frames and samples are in order of time; there is at least one sample.
std::vector<FrameOfSample> FramesOfSamples(const std::vector<TimeNs>& frames_ns,
                                           const std::vector<TimeNs>& samples_ns,
                                           TimeNs most_apart_ns);

/// The element nearest to a time, the earlier one of two; nothing of an empty list.
std::optional<std::size_t> NearestOf(const std::vector<TimeNs>& times_ns, TimeNs t_ns);

}  // namespace tera
