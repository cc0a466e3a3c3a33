#pragma once

#include <vector>

#include "diagnose/replay/axis_log.h"
#include "resimulate/simulated_course.h"

namespace tera {

/// What encoders, free of errors, would have measured in the simulation: the same axes at the same
/// times, as far as it goes. Axes that the machine lacks stay as they were measured.
std::vector<NamedEncoders> AsSimulated(const MachineModel& model, const SimulatedCourse& course,
                                       std::vector<NamedEncoders> measured);

/// The simulated poses at the times of the measured ones, as far as the simulation goes.
std::vector<TruthPose> AsSimulated(const SimulatedCourse& course,
                                   const std::vector<TruthPose>& measured);

}  // namespace tera
