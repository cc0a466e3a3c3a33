#pragma once

#include <optional>
#include <vector>

#include "dataset/import/clocks/motion_series.h"

/// Lag l between two series: the second shows at t + l what the first shows at t.

namespace tera {

/// Values of a series by time in s, averaged over the same interval as another's.
class SmoothSeries {
 public:
  SmoothSeries(const MotionSeries& series, double averaged_s);

  /// Linear interpolation; NaN for missing values.
  float At(double t_s) const;
  double first_s() const { return first_s_; }
  double last_s() const;

 private:
  double first_s_, step_s_;
  std::vector<float> values_;
};

struct CoarseLag {
  double lag_s = 0;
  double from_s = 0, length_s = 0;  ///< compared segment of the first series
  double correlation = 0;
  double width_s = 0;     ///< half height width of the correlation's peak
  bool opposite = false;  ///< the series have opposite signs
  /// No other lag has a similar correlation.
  bool is_alone = false;
};

/// Returns nothing if the series share no comparable segment.
std::optional<CoarseLag> FindCoarseLag(const MotionSeries& first, const MotionSeries& second,
                                       double longest_segment_s, double most_lag_s);

/// The lag of a stretch of the first series.
struct Stretch {
  double middle_s = 0;  ///< by the first series' clock
  double lag_s = 0;
  double weight = 0;  ///< inverse variance of the lag, up to a factor
};

class StretchedLags {
 public:
  StretchedLags(const MotionSeries& first, const MotionSeries& second, double averaged_s);

  /// Duration for which both series exist at a lag.
  double overlap_s(double lag_s) const;
  /// All stretches of a length with enough motion and correlation, in order of time. Each search
  /// starts at the neighbour's lag, from the segment of `coarse` outwards.
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
