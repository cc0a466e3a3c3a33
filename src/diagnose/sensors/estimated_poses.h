#pragma once

#include <vector>

#include "core/types/measurement.h"
#include "diagnose/sensors/sensor_diagnosis.h"

namespace tera {

/// Poses of the base in W from the estimated motion, every 0.1 s of the observed time. Empty if
/// position or heading would depend on running gear alone. Two receivers are needed, or one
/// receiver and an inertial unit.
///
/// Model   running gear has little weight where there are receivers: its deviation is a third of
///         its speed. Parts of the motion are estimated separately. At their border both move to
///         the middle of the difference. Each part spreads its correction over its whole length,
///         because a jump would look like a turn.
/// Omits   the uncertainty of the motion, which a comparison takes for noise; velocities, which
///         stay unset.
std::vector<TruthPose> EstimatedPoses(const SensorDiagnosis& estimate);

}  // namespace tera
