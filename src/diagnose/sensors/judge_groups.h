#pragma once

#include <string>
#include <vector>

#include "diagnose/sensors/sensor_parameters.h"

namespace tera {

struct JudgeOptions {
  double alpha = 0.01;  ///< for all groups together, and of each rival that is rejected
  int most_named = 4;
};

/// A number with its estimate where its group is free.
struct JudgedParameter {
  double value = 0, sigma = 0;  ///< in SI units
  bool is_beyond = false;       ///< its tolerance, with the whole of its interval
};

/// A group that is named: nothing within the tolerances of all others explains the recording as
/// well.
struct NamedGroup {
  int group = 0;
  std::vector<JudgedParameter> parameters;
  double gain = 0;          ///< of log-likelihood on segments that it was not fitted to
  double p = 1;             ///< of as steady a gain by chance
  std::vector<int> rivals;  ///< groups in whose place it is neither much likelier nor better
};

struct GroupJudgement {
  std::vector<NamedGroup> named;
  std::vector<std::vector<int>>
      not_told_apart;       ///< groups whose effects cancel, none of them named
  std::vector<int> within;  ///< differ from the documented, within tolerance
  /// Unnamed groups beyond tolerance where they alone are free as well, with a gain on held-out
  /// parts of the recording. The gain is not steady, or something else explains it.
  std::vector<NamedGroup> unproven;
  std::vector<int> untestable;                         ///< their error exceeds their tolerance
  std::vector<std::vector<JudgedParameter>> by_group;  ///< each where it alone is free
  Eigen::VectorXd parameters;                          ///< best with the named free
  double left_to_gain = 0;  ///< of log-likelihood, if all else were free as well
};

/// Which groups lie beyond their tolerance.
///
/// Model   each segment is a quadratic over the parameters. The test of a group is its gain on each
///         segment, of parameters fitted to all other segments. They are fitted with the group
///         free, and with it and all others within tolerance (SmallestWithin). SteadyEffectP over
///         segments judges how steady the gain is. A tolerance is a bound: a mere prior would yield
///         to the data, and a large error would then gain nothing from being free.
///         A group is admissible if its p is small enough for as many groups and none of its
///         numbers is at the end of its range. One number must also lie beyond its tolerance with
///         its whole interval of 95 %. The group with the largest posterior of the recording
///         enters, the priors of all numbers within tolerance included. Named groups that become
///         inadmissible leave.
///         Errors are the larger of the posterior's and of the block jackknife's over a dozen parts
///         of the recording. Intervals are those of Student's t. A wrong model makes a posterior
///         sharp, but its parts disagree.
/// Omits   nonlinear effects: linearise again where many groups were named.
/// Source  Ibragimov and Mueller 2010; Kuensch 1989, "The jackknife and the bootstrap for general
///         stationary observations".
GroupJudgement JudgeGroups(const ParameterTable& table,
                           const std::vector<ParameterQuadratic>& segments,
                           const JudgeOptions& options = {});

}  // namespace tera
