#include "dataset/export/nuscenes/key_frames.h"

#include <algorithm>
#include <cstdlib>

namespace tera {
namespace {

constexpr TimeNs kJitter_ns = 1'000'000;

}  // namespace

std::vector<TimeNs> SampleTimes(const std::vector<TimeNs>& frames_ns, TimeNs period_ns) {
  std::vector<TimeNs> samples_ns;
  for (const TimeNs t_ns : frames_ns) {
    if (samples_ns.empty() || t_ns - samples_ns.back() >= period_ns - kJitter_ns) {
      samples_ns.push_back(t_ns);
    }
  }
  return samples_ns;
}

std::optional<std::size_t> NearestOf(const std::vector<TimeNs>& times_ns, TimeNs t_ns) {
  if (times_ns.empty()) return std::nullopt;
  const auto after = std::lower_bound(times_ns.begin(), times_ns.end(), t_ns);
  if (after == times_ns.begin()) return 0;
  const auto before = after - 1;
  const bool is_before = after == times_ns.end() || t_ns - *before <= *after - t_ns;
  return static_cast<std::size_t>((is_before ? before : after) - times_ns.begin());
}

std::vector<FrameOfSample> FramesOfSamples(const std::vector<TimeNs>& frames_ns,
                                           const std::vector<TimeNs>& samples_ns,
                                           TimeNs most_apart_ns) {
  std::vector<FrameOfSample> frames;
  for (std::size_t f = 0; f < frames_ns.size(); ++f) {
    const TimeNs t_ns = frames_ns[f];
    const std::size_t nearest = *NearestOf(samples_ns, t_ns);
    const bool is_key = NearestOf(frames_ns, samples_ns[nearest]) == f &&
                        std::abs(samples_ns[nearest] - t_ns) <= most_apart_ns;
    const auto next = std::lower_bound(samples_ns.begin(), samples_ns.end(), t_ns);
    const auto following = static_cast<std::size_t>(next - samples_ns.begin());
    frames.push_back({is_key ? nearest : std::min(following, samples_ns.size() - 1), is_key});
  }
  return frames;
}

}  // namespace tera
