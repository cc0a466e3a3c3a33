#pragma once

#include <vector>

#include "diagnose/replay/axis_log.h"
#include "resimulate/motion/simulated_course.h"

namespace tera {

/// Samples of error-free encoders in the simulation, for the axes and times of `measured`, up to
/// the simulation's end. Axes that the machine lacks keep their measurements.
std::vector<NamedEncoders> AsSimulated(const MachineModel& model, const SimulatedCourse& course,
                                       std::vector<NamedEncoders> measured);

/// Simulated poses at the times of the measured ones, up to the simulation's end.
std::vector<TruthPose> AsSimulated(const SimulatedCourse& course,
                                   const std::vector<TruthPose>& measured);

}  // namespace tera
