#pragma once

#include <optional>
#include <vector>

#include "diagnose/motion/filtered_unit.h"
#include "diagnose/motion/linearised_observation.h"

namespace tera {

/// Linearises the observations of one segment about its motion and the parameters. Both must
/// outlive this object.
///
/// Model   An inertial unit measures turn rates and specific forces in its true frame, averaged
///         over the observation (UniformSpline::MeanOver), then filter, signs, scale and bias. A
///         receiver measures the position of its antenna. Each channel sees the motion later by its
///         delay parameter. Accelerations enter inertial units with a gain for each coordinate of
///         the motion, which all units share.
///
///         Derivatives by parameters use the motion with insignificant rates set to zero
///         (SegmentMotion::moving). A motion that follows the noise of a sensor would seem to
///         excite the scale, mount and delay of that sensor. The noise would then bias these
///         parameters (errors in variables).
///
///         Rows of a filtered unit have zero derivatives by the motion and by the acceleration
///         gains, because the filter mixes in motion from before the observation. Derivatives of a
///         filtered unit by mount and place ignore the filter, but use the motion one time constant
///         earlier.
///
/// Omits   products of motions that change within an observation; filters of receivers and
///         encoders, which count as delays.
class SegmentLinearisation {
 public:
  SegmentLinearisation(const MotionProblem& problem, const UniformSpline& spline,
                       const SegmentMotion& motion, const Eigen::VectorXd& parameters);
  /// Fills `out`. False if the spline does not cover the time of the observation.
  bool Of(const Observation& observation, LinearisedObservation* out) const;

 private:
  FilteredUnit Filtered(const UnitChannel& unit) const;
  double DelayOf(const Observation& observation) const;

  const MotionProblem& problem_;
  const UniformSpline& spline_;
  const SegmentMotion& motion_;
  const Eigen::VectorXd& parameters_;
  std::vector<std::optional<FilteredUnit>> filtered_;  ///< one per unit; empty without a filter
};

}  // namespace tera
