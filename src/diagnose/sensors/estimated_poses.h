#pragma once

#include <vector>

#include "core/types/measurement.h"
#include "diagnose/sensors/sensor_diagnosis.h"

namespace tera {

/// Poses of the base, in W, by the motion that all sensors imply, every 0.1 s of the observed time.
/// Empty where its place or heading is unknown without running gear. They are known by two
/// receivers, or by one and an inertial unit.
///
/// Model   running gear contributes to that motion with an error of a third of its speed, almost
///         without weight beside receivers. Parts of the motion were estimated separately.
///         Neighbours meet in the middle of their difference, and each part spreads its correction
///         over its whole length: a jump would seem to be a turn.
/// Omits   the uncertainty of the motion, which a comparison takes for noise. Velocities are not
///         set.
std::vector<TruthPose> EstimatedPoses(const SensorDiagnosis& estimate);

}  // namespace tera
