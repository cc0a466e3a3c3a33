#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/time.h"
#include "core/types/measurement.h"

namespace tera {

/// Kind of motion. Two series can be compared only if they have the same kind.
enum class MotionKind {
  kTurn,       ///< turn rate about one axis, in rad/s; the sign depends on the channel
  kTurnSize,   ///< magnitude of the turn rate, in rad/s
  kSpeedSize,  ///< magnitude proportional to the ground speed in m/s
};

/// A motion on a regular time grid of the channel's own clock.
struct MotionSeries {
  std::string what;  ///< name, such as "wy", "boom" or "course rate"
  MotionKind kind = MotionKind::kTurn;
  TimeNs first_ns = 0, step_ns = 0;
  /// Interval over which each value is an average, centred on its time, in s.
  double averaged_s = 0;
  std::vector<float> values;  ///< NaN where missing

  TimeNs end_ns() const { return first_ns + step_ns * static_cast<TimeNs>(values.size()); }
};

/// Motions measured by one channel.
struct ChannelMotion {
  std::string path;
  std::string clock;      ///< equal for channels that share a clock
  double interval_s = 0;  ///< interval between rows
  std::vector<MotionSeries> series;
};

/// Resamples a channel's `count` rows to a grid. The step is the median interval, at least 5 ms.
/// Values are means over the step. Gaps of up to a second are interpolated linearly; longer gaps
/// stay empty.
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

/// Returns the sample of a row.
template <typename Sample>
using SampleOfRow = std::function<Sample(std::size_t row)>;

/// Motions of an IMU: the rate about each axis, and the total rate.
std::vector<MotionSeries> MotionOf(std::size_t count, const SampleOfRow<ImuSample>& sample);
/// Motions of encoders: the rate of each revolute joint, and sums of neighbouring joints, because
/// the rotation of a link is the sum of the joints before it. Also the magnitude of each joint's
/// rate, both as a turn rate and as a drive speed.
std::vector<MotionSeries> MotionOf(const std::vector<EncoderAxis>& axes,
                                   const std::vector<EncoderSample>& samples);
/// Motions of a GNSS receiver: speed, and course rate while moving.
std::vector<MotionSeries> MotionOf(const std::vector<GnssSample>& samples);
/// Motions of poses: speed, turn rate about the world's z axis, and total turn rate.
std::vector<MotionSeries> MotionOf(std::size_t count, const SampleOfRow<TruthPose>& pose);

}  // namespace tera
