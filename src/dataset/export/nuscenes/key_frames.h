#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/time.h"

namespace tera {

/// Times of samples, which are fully annotated. The first frame is a sample. Each next sample is
/// the first frame at least `period_ns` after the last sample, minus 1 ms for jitter.
std::vector<TimeNs> SampleTimes(const std::vector<TimeNs>& frames_ns, TimeNs period_ns);

/// The sample to which a frame belongs, and whether the frame is its key frame.
struct FrameOfSample {
  std::size_t sample = 0;
  bool is_key = false;
};

/// Assigns the frames of a sensor to samples.
///
/// Model   A frame is the key frame of a sample if each is the nearest to the other and they are at
///         most `most_apart_ns` apart. So a sample has at most one key frame per sensor, and a
///         frame is the key frame of at most one sample. Any other frame belongs to the next
///         sample, or to the last one if none follows. Both lists are in order of time; there is at
///         least one sample.
std::vector<FrameOfSample> FramesOfSamples(const std::vector<TimeNs>& frames_ns,
                                           const std::vector<TimeNs>& samples_ns,
                                           TimeNs most_apart_ns);

/// Index of the time nearest to `t_ns`, the earlier one on a tie; nullopt for an empty list.
std::optional<std::size_t> NearestOf(const std::vector<TimeNs>& times_ns, TimeNs t_ns);

}  // namespace tera
