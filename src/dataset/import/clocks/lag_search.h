#pragma once

#include <optional>
#include <vector>

#include "dataset/import/clocks/motion_series.h"

/// By how much one series is behind another: at the lag l, what the first tells at t the second
/// tells at t + l.

namespace tera {

/// Values of a series, averaged over the same time as another's, by time in s.
class SmoothSeries {
 public:
  SmoothSeries(const MotionSeries& series, double averaged_s);

  /// On the straight line between two values; NaN where there is nothing.
  float At(double t_s) const;
  double first_s() const { return first_s_; }
  double last_s() const;

 private:
  double first_s_, step_s_;
  std::vector<float> values_;
};

struct CoarseLag {
  double lag_s = 0;
  double from_s = 0, length_s = 0;  ///< of the segment of the first series that was compared
  double correlation = 0;
  double width_s = 0;     ///< of the correlation's peak, where it is half as high
  bool opposite = false;  ///< signs are opposite
  /// No other lag comes near.
  bool is_alone = false;
};

/// Nothing where the series have no segment in common that can be compared.
std::optional<CoarseLag> FindCoarseLag(const MotionSeries& first, const MotionSeries& second,
                                       double longest_segment_s, double most_lag_s);

/// The lag of a stretch of the first series.
struct Stretch {
  double middle_s = 0;  ///< by the first series' clock
  double lag_s = 0;
  double weight = 0;  ///< one over the variance of the lag, up to a factor
};

class StretchedLags {
 public:
  StretchedLags(const MotionSeries& first, const MotionSeries& second, double averaged_s);

  /// How long both series are there at a lag.
  double overlap_s(double lag_s) const;
  /// All stretches of a length that have motion and correlate well enough, in order of time; each
  /// is looked for near the lag of the one beside it, from the segment of `coarse` outwards.
  std::vector<Stretch> All(const CoarseLag& coarse, double length_s,
                           double least_correlation) const;

 private:
  struct Match {
    double correlation = 0, motion = 0, sharpness = 0;
  };
  std::optional<Stretch> Near(double from_s, double length_s, double lag_s, double sign,
                              double least_correlation, double least_motion) const;
  Match At(double from_s, double length_s, double lag_s) const;

  SmoothSeries first_, second_;
  double step_s_;
};

}  // namespace tera
