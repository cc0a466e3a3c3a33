#pragma once

#include <vector>

#include "diagnose/motion/motion_problem.h"
#include "diagnose/motion/normal_equations.h"
#include "diagnose/sensors/judge_groups.h"
#include "diagnose/sensors/sensor_parameters.h"

namespace tera {

/// How large what a group changes in the measurements is beside their noise.
///
/// Model   sqrt(d' I d / n) of a segment: d what the group's numbers that lie beyond tolerance
/// differ
///         by from the documented ones (what is as expected of the others is no finding), I what
///         the segment tells of them where all others stay and the motion follows, n its tenths of
///         a second. Of all segments the third largest: as much is there in three of them, or in
///         all where there are fewer.
/// Omits   that noise differs from sensor to sensor: an effect of a few counts as if all bore it.
double SignalToNoise(const MotionProblem& motion, const std::vector<ParameterQuadratic>& segments,
                     const ParameterTable& table, const NamedGroup& found);

}  // namespace tera
