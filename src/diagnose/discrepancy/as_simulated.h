#pragma once

#include <vector>

#include "diagnose/replay/axis_log.h"
#include "resimulate/motion/simulated_course.h"

namespace tera {

/// The samples that encoders without errors would have measured in the simulation, for the axes and
/// times of `measured`, as far as the simulation goes. Axes that the machine lacks stay as
/// measured.
std::vector<NamedEncoders> AsSimulated(const MachineModel& model, const SimulatedCourse& course,
                                       std::vector<NamedEncoders> measured);

/// The simulated poses at the times of the measured ones, as far as the simulation goes.
std::vector<TruthPose> AsSimulated(const SimulatedCourse& course,
                                   const std::vector<TruthPose>& measured);

}  // namespace tera
