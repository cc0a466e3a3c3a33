#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/time.h"
#include "core/types/measurement.h"

namespace tera {

/// Kind of motion in a series. Series of one kind can show the same motion.
enum class MotionKind {
  kTurn,       ///< rad/s about some axis, with a channel-dependent sign
  kTurnSize,   ///< rad/s about any axis, unsigned
  kSpeedSize,  ///< proportional to the ground speed in m/s, unsigned
};

/// A motion over time on a grid of its channel's own clock.
struct MotionSeries {
  std::string what;  ///< "wy", "boom", "course rate"
  MotionKind kind = MotionKind::kTurn;
  TimeNs first_ns = 0, step_ns = 0;
  /// Averaging time of the values about their own time, s.
  double averaged_s = 0;
  std::vector<float> values;  ///< NaN for missing values

  TimeNs end_ns() const { return first_ns + step_ns * static_cast<TimeNs>(values.size()); }
};

/// The motions in one channel.
struct ChannelMotion {
  std::string path;
  std::string clock;      ///< equal for channels with the same clock
  double interval_s = 0;  ///< between rows
  std::vector<MotionSeries> series;
};

/// Series from a channel's `count` rows: means over steps of the median interval, at least 5 ms.
/// Gaps up to a second are interpolated linearly; longer ones stay empty.
class MotionGrid {
 public:
  MotionGrid(std::size_t count, const std::function<TimeNs(std::size_t)>& time);

  /// True if the channel has too few rows.
  bool empty() const { return step_ns_ == 0; }
  double step_s() const { return ToSeconds(step_ns_); }
  MotionSeries Series(const std::string& what, MotionKind kind,
                      const std::function<double(std::size_t)>& value) const;

 private:
  std::size_t count_;
  std::function<TimeNs(std::size_t)> time_;
  TimeNs first_ns_ = 0, step_ns_ = 0, interval_ns_ = 0;
  std::size_t cells_ = 0;
};

/// The sample of a row of a channel of `count` rows.
template <typename Sample>
using SampleOfRow = std::function<Sample(std::size_t row)>;

/// Motion of an inertial unit: about each axis, and the total rate.
std::vector<MotionSeries> MotionOf(std::size_t count, const SampleOfRow<ImuSample>& sample);
/// Motion of encoders. Each turning joint, and sums of neighbours, since a link turns by the sum of
/// the preceding joints. Also each joint's magnitude, as a turn and as a drive.
std::vector<MotionSeries> MotionOf(const std::vector<EncoderAxis>& axes,
                                   const std::vector<EncoderSample>& samples);
/// Motion of a receiver: speed, and course rate while moving.
std::vector<MotionSeries> MotionOf(const std::vector<GnssSample>& samples);
/// Motion of poses: speed, turn about the world's z, and total turn.
std::vector<MotionSeries> MotionOf(std::size_t count, const SampleOfRow<TruthPose>& pose);

}  // namespace tera
