#pragma once

#include <optional>
#include <vector>

#include "diagnose/motion/filtered_unit.h"
#include "diagnose/motion/linearised_observation.h"

namespace tera {

/// Linearises observations of one segment about its motion and parameters, which must outlive this.
///
/// Model   an inertial unit: rates and forces of its true frame, averaged over the observation as
///         the splines are (UniformSpline::MeanOver), filter, signs, scale, bias. A receiver: its
///         antenna's place. All are as late as their parameter says. Accelerations count in
///         inertial units with the gain of their number of the motion, which all units share.
///         Derivatives by parameters are those of a motion that rests where it does not exceed its
///         noise. Otherwise a motion that follows a sensor's noise would seem to excite its scale,
///         place and delay, and the noise would bias these (errors in variables). A filtered unit
///         says nothing of the motion, nor of gains of accelerations, which reach it from before
///         the observation. Its derivatives by mount and place are unfiltered, and late instead.
/// Omits   products of motions that change within an observation; filters of receivers and
///         encoders, which count as delays.
class SegmentLinearisation {
 public:
  SegmentLinearisation(const MotionProblem& problem, const UniformSpline& spline,
                       const SegmentMotion& motion, const Eigen::VectorXd& parameters);
  /// Fills `out`; false where the motion does not cover the time of the observation.
  bool Of(const Observation& observation, LinearisedObservation* out) const;

 private:
  FilteredUnit Filtered(const UnitChannel& unit) const;
  double DelayOf(const Observation& observation) const;

  const MotionProblem& problem_;
  const UniformSpline& spline_;
  const SegmentMotion& motion_;
  const Eigen::VectorXd& parameters_;
  std::vector<std::optional<FilteredUnit>> filtered_;  ///< by unit; none without a filter
};

}  // namespace tera
