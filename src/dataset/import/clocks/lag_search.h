#pragma once

#include <optional>
#include <vector>

#include "dataset/import/clocks/motion_series.h"

/// Search for the lag between two series. With lag l, the second series at t + l equals the first
/// series at t.

namespace tera {

/// A series that is averaged so that two series have the same averaging interval.
class SmoothSeries {
 public:
  SmoothSeries(const MotionSeries& series, double averaged_s);

  /// Linear interpolation; NaN where values are missing.
  float At(double t_s) const;
  double first_s() const { return first_s_; }
  double last_s() const;

 private:
  double first_s_, step_s_;
  std::vector<float> values_;
};

struct CoarseLag {
  double lag_s = 0;
  double from_s = 0, length_s = 0;  ///< segment of the first series that was compared
  double correlation = 0;
  double width_s = 0;     ///< half width of the correlation peak at half height
  bool opposite = false;  ///< the series have opposite signs
  /// True if no other lag has a similar correlation.
  bool is_alone = false;
};

/// Returns nullopt if the series have no segment in common that can be compared.
std::optional<CoarseLag> FindCoarseLag(const MotionSeries& first, const MotionSeries& second,
                                       double longest_segment_s, double most_lag_s);

/// Lag of a short stretch of the first series.
struct Stretch {
  double middle_s = 0;  ///< time on the first series' clock
  double lag_s = 0;
  double weight = 0;  ///< proportional to the inverse variance of the lag
};

class StretchedLags {
 public:
  StretchedLags(const MotionSeries& first, const MotionSeries& second, double averaged_s);

  /// Duration for which both series have values at a lag.
  double overlap_s(double lag_s) const;
  /// Lags of all stretches of length `length_s` that have enough motion and correlation, in order
  /// of time. The search starts in the segment of `coarse` and proceeds outwards; each stretch
  /// starts from the lag of its neighbour.
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
