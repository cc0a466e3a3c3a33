#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/time.h"

namespace tera {

/// Times of full annotation: the first frame of a sensor, then each first frame that is `period_ns`
/// later than the last. A millisecond of jitter is allowed.
std::vector<TimeNs> SampleTimes(const std::vector<TimeNs>& frames_ns, TimeNs period_ns);

/// A frame's sample, and whether the frame is its key frame.
struct FrameOfSample {
  std::size_t sample = 0;
  bool is_key = false;
};

/// Assigns frames to samples.
///
/// Model   a frame is a sample's key frame if each is the other's nearest and they are at most
///         `most_apart_ns` apart. No sample then has two key frames of a sensor, and no frame two
///         samples. Any other frame belongs to the next sample, or to the last one at the end.
///         Frames and samples are in order of time; there is at least one sample.
std::vector<FrameOfSample> FramesOfSamples(const std::vector<TimeNs>& frames_ns,
                                           const std::vector<TimeNs>& samples_ns,
                                           TimeNs most_apart_ns);

/// Index of the element nearest to a time, the earlier one of two; nothing for an empty list.
std::optional<std::size_t> NearestOf(const std::vector<TimeNs>& times_ns, TimeNs t_ns);

}  // namespace tera
