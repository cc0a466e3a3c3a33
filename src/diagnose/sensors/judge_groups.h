#pragma once

#include <string>
#include <vector>

#include "diagnose/sensors/sensor_parameters.h"

namespace tera {

struct JudgeOptions {
  double alpha = 0.01;  ///< level for all groups together, and for the rejection of each rival
  int most_named = 4;
};

/// A parameter, estimated with its group free.
struct JudgedParameter {
  double value = 0, sigma = 0;  ///< value and standard deviation in SI units
  bool is_beyond = false;       ///< the 95 % interval lies outside the tolerance
};

/// A named group: other groups within their tolerances do not explain the recording as well.
struct NamedGroup {
  int group = 0;
  std::vector<JudgedParameter> parameters;
  double gain = 0;          ///< gain in log-likelihood on segments left out of the fit
  double p = 1;             ///< p-value of the steadiness of this gain
  std::vector<int> rivals;  ///< groups that explain the recording about as well instead
};

struct GroupJudgement {
  std::vector<NamedGroup> named;
  std::vector<std::vector<int>>
      not_told_apart;       ///< pairs of groups whose effects cancel, none of them named
  std::vector<int> within;  ///< significantly off the documented value, but within tolerance
  /// Unnamed groups that lie beyond tolerance when freed in addition to the named ones, with a gain
  /// on held-out segments. The gain is not steady, or another group explains it.
  std::vector<NamedGroup> unproven;
  std::vector<int> untestable;  ///< standard deviation exceeds the tolerance
  /// Each group freed in addition to the named ones.
  std::vector<std::vector<JudgedParameter>> by_group;
  Eigen::VectorXd parameters;  ///< fitted with the named groups free
  double left_to_gain = 0;     ///< gain in log-likelihood if all groups were free
};

/// Decides which groups lie beyond their tolerances.
///
/// Model   each segment is a quadratic over the parameters. A group is tested by its gain on each
///         segment, with parameters fitted to all other segments. Two such fits are compared: with
///         the group free, and with the group held within tolerance. Groups not free stay within
///         tolerance in both (SmallestWithin). SteadyEffectP over segments gives the p-value. The
///         tolerance is a bound: under a mere prior, a large error would shift the held group, and
///         freeing it would gain nothing.
///
///         A group is admissible if three conditions hold. Its p is below alpha over the number of
///         groups. None of its parameters is at the end of its range. The 95 % interval of at least
///         one lies beyond tolerance. Among the admissible groups, the one with the largest
///         posterior of the recording enters, including the priors of all parameters held within
///         tolerance. A named group that becomes inadmissible leaves.
///
///         The standard deviation is the larger of the posterior's and that of the block jackknife
///         over at most twelve parts of the recording. Intervals follow Student's t. A wrong model
///         makes the posterior too sharp, but its parts then disagree.
/// Omits   nonlinear effects. The caller linearises again with the named groups free.
/// Source  Ibragimov and Mueller 2010; Kuensch 1989, "The jackknife and the bootstrap for general
///         stationary observations".
GroupJudgement JudgeGroups(const ParameterTable& table,
                           const std::vector<ParameterQuadratic>& segments,
                           const JudgeOptions& options = {});

}  // namespace tera
