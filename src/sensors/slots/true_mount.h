#pragma once

#include "core/motion.h"
#include "core/types/effects.h"

/// Slot `sensor_geometry`: where a sensor truly sits, while sensor.yaml says where it should.

namespace tera {

/// The pose that a sensor has on its link B, where `X_BS` is the documented one.
///
/// Frames  B link, S sensor as documented, T sensor as it is.
/// Model   p_BT = p_BS + d_B (`imu_lever_arm`, `gnss_lever_arm`, `extrinsic`);
///         R_BT = R_BS R(roll, pitch, yaw) (`mount_rotation`, `extrinsic`), about the axes of S.
Pose TrueMount(const Pose& X_BS, const Effects& effects);

}  // namespace tera
