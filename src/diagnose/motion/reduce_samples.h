#pragma once

#include <functional>
#include <vector>

#include "core/types/measurement.h"
#include "diagnose/motion/starting_motion.h"

namespace tera {

/// The mean of consecutive samples of an inertial unit over their true time.
struct ImuWindow {
  TimeNs from_ns = 0, to_ns = 0;
  Vec3 w_S_radps = Vec3::Zero(), f_S_mps2 = Vec3::Zero();
  double share = 1;  ///< samples in it over those of a window without lost rows
  /// 1 sigma of the part that splines with knots as far apart as windows leave out: of rates, then
  /// forces.
  Eigen::Matrix<double, 6, 1> model_error = Eigen::Matrix<double, 6, 1>::Zero();
};

/// The usual time from sample to sample, 0 for fewer than two.
TimeNs UsualPeriod_ns(const std::vector<TimeNs>& t_ns);

/// Reduces samples, each a mean over the usual period before its stamp, to windows of at most
/// `longest_s`. A lost row, or a change of `segment_of`, ends a window.
///
/// Model   model error is a quarter of the excess of the means' largest second difference around a
///         window over three of its robust deviations. A blow of turning shows by half in the rates
///         of two windows, but in the forces of one. Rates and forces then disagree by a quarter of
///         the forces' second difference. Windows next to a lost row have none.
/// Omits   the effect of jittering stamps on slopes.
std::vector<ImuWindow> WindowsOf(const std::vector<ImuSample>& samples, double longest_s,
                                 const std::function<int(TimeNs)>& segment_of);

/// Standard deviations of white noise, of rates, then forces, in means over a time of an inertial
/// unit's samples (WhiteNoise).
Eigen::Matrix<double, 6, 1> WhiteNoiseOf(const std::vector<ImuSample>& samples, double over_s);

/// Sets `motion` of each inertial unit's noise channels: the deviation of their observations over
/// all segments.
void SetMotionOfUnits(MotionProblem* problem);

/// One running gear's angle over time, and how far it moves the machine for one radian.
struct GearTrack {
  TimeSeries angle_rad;
  double resolution_rad = 0;        ///< of the encoder
  double radius_m = 0, left_m = 0;  ///< how far left of the base's middle it runs
};

/// Travel over times of 0.1 s at least. Gear is still where no angle moves by more than its noise
/// and quantisation within 0.3 s before and after.
std::vector<TravelWindow> TravelOf(const std::vector<GearTrack>& gears);

}  // namespace tera
