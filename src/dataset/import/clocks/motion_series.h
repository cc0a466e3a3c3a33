#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/time.h"
#include "core/types/measurement.h"

namespace tera {

/// What a series tells of a motion. Series of one kind can be of the same motion.
enum class MotionKind {
  kTurn,       ///< rad/s about some axis, with a sign that depends on who tells it
  kTurnSize,   ///< rad/s about whatever axis, without sign
  kSpeedSize,  ///< proportional to m/s over the ground, without sign
};

/// A motion over time on a grid of its channel's own clock.
struct MotionSeries {
  std::string what;  ///< "wy", "boom", "course rate"
  MotionKind kind = MotionKind::kTurn;
  TimeNs first_ns = 0, step_ns = 0;
  /// Values are means over so long about their time already, s.
  double averaged_s = 0;
  std::vector<float> values;  ///< NaN where the channel told nothing

  TimeNs end_ns() const { return first_ns + step_ns * static_cast<TimeNs>(values.size()); }
};

/// What one channel tells of motions.
struct ChannelMotion {
  std::string path;
  std::string clock;      ///< whatever has the same has the same clock
  double interval_s = 0;  ///< from row to row
  std::vector<MotionSeries> series;
};

/// Series from a channel's rows, of which there are `count`: means over steps of the median
/// interval, at least 5 ms; between rows up to a second apart the straight line, else nothing.
class MotionGrid {
 public:
  MotionGrid(std::size_t count, const std::function<TimeNs(std::size_t)>& time);

  /// Nothing where the channel has too few rows to tell a motion.
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

/// Of an inertial unit: about each axis, and in all.
std::vector<MotionSeries> MotionOf(std::size_t count, const SampleOfRow<ImuSample>& sample);
/// Of each joint that turns, of neighbours together (a link turns by the sum of those before it),
/// and of each by size, as a turn and as what drives the machine on.
std::vector<MotionSeries> MotionOf(const std::vector<EncoderAxis>& axes,
                                   const std::vector<EncoderSample>& samples);
/// Speed, and how fast its direction turns where it moves.
std::vector<MotionSeries> MotionOf(const std::vector<GnssSample>& samples);
/// Speed, turn about the world's z and turn in all.
std::vector<MotionSeries> MotionOf(std::size_t count, const SampleOfRow<TruthPose>& pose);

}  // namespace tera
