#pragma once

#include <functional>
#include <vector>

#include "core/types/measurement.h"
#include "diagnose/motion/starting_motion.h"

namespace tera {

/// The mean of consecutive samples of an inertial unit.
struct ImuWindow {
  TimeNs from_ns = 0, to_ns = 0;
  Vec3 w_S_radps = Vec3::Zero(), f_S_mps2 = Vec3::Zero();
  double share = 1;  ///< number of samples / number in a window without lost rows
  /// 1 sigma of the part of the motion that a spline with one knot per window cannot represent:
  /// turn rates, then specific forces.
  Eigen::Matrix<double, 6, 1> model_error = Eigen::Matrix<double, 6, 1>::Zero();
};

/// Median time between samples; 0 for fewer than two.
TimeNs UsualPeriod_ns(const std::vector<TimeNs>& t_ns);

/// Averages samples over windows of at most `longest_s`. Each sample is a mean over the usual
/// period before its stamp. A lost row or a change of `segment_of` ends a window.
///
/// Model   model error = max(0, d - 3 s) / 4. d is the largest magnitude of the second difference
///         of means around a window, and s is the robust deviation of all second differences.
///         Second differences next to a lost row count as 0. Reason for the quarter: a short
///         angular impulse changes the mean rate by halves in two windows, but its force appears in
///         one window. Rates and forces then disagree by a quarter of the second difference of the
///         forces.
/// Omits   the effect of jitter of stamps on slopes.
std::vector<ImuWindow> WindowsOf(const std::vector<ImuSample>& samples, double longest_s,
                                 const std::function<int(TimeNs)>& segment_of);

/// Standard deviation of white noise (WhiteNoise) in means of samples over `over_s`: turn rates,
/// then specific forces.
Eigen::Matrix<double, 6, 1> WhiteNoiseOf(const std::vector<ImuSample>& samples, double over_s);

/// Sets NoiseChannel::motion of each inertial unit: the standard deviation of its observations over
/// all segments.
void SetMotionOfUnits(MotionProblem* problem);

struct GearTrack {
  TimeSeries angle_rad;
  double resolution_rad = 0;
  /// Travel of a running gear per radian of its encoder; its distance to the left of the base's
  /// centre.
  double radius_m = 0, left_m = 0;
};

/// Travel in windows of at least 0.1 s. The running gear is at rest in a window if no angle moves
/// by more than noise and quantisation from 0.3 s before to 0.3 s after the window.
std::vector<TravelWindow> TravelOf(const std::vector<GearTrack>& gears);

}  // namespace tera
