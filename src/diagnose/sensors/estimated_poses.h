#pragma once

#include <vector>

#include "core/types/measurement.h"
#include "diagnose/sensors/sensor_diagnosis.h"

namespace tera {

/// Poses of the base, in W, by the motion that all sensors imply: every 0.1 s of what was observed.
/// Empty where its place or heading is not known without running gear, which takes two receivers,
/// or one and an inertial unit.
///
/// Model   running gear had a say in that motion, with an error of a third of its speed, which
///         beside receivers weighs next to nothing. Parts of the motion were estimated each by
///         itself and meet in the middle of where they differ, from which a part is led away over
///         its whole length: a jump would seem to be a turn.
/// Omits   the uncertainty of the motion: what is compared with it takes it for noise. Velocities
///         are not set.
std::vector<TruthPose> EstimatedPoses(const SensorDiagnosis& estimate);

}  // namespace tera
