#pragma once

#include "core/motion.h"
#include "core/types/effects.h"

/// Slot `sensor_geometry`: the true mounting of a sensor, which sensor.yaml does not show.

namespace tera {

/// True pose of a sensor on its link B; `X_BS` is the documented pose.
///
/// Frames  B link, S documented sensor, T true sensor.
/// Model   p_BT = p_BS + d_B (`imu_lever_arm`, `gnss_lever_arm`, `extrinsic`); R_BT = R_BS R(roll,
///         pitch, yaw) (`mount_rotation`, `extrinsic`), about the axes of S.
Pose TrueMount(const Pose& X_BS, const Effects& effects);

}  // namespace tera
