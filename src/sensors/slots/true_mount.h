#pragma once

#include <string>

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

/// One antenna of a machine, as documented, with its effects.
struct Antenna {
  std::string link;
  Pose X_BS = Pose::Identity();
  Effects effects;
};

/// Where the antenna is whose signal the receiver of `own` gets.
///
/// Frames  B the antenna's link.
/// Model   `antenna_swap` on either of the two: the true mount of `other`, the receivers' noise
///         staying where it was. `antenna_yaw` on either: both turned about the vertical of B
///         through the middle between their documented places.
/// Omits   antennas on different links for `antenna_yaw`; phase centres that move with elevation.
struct AntennaPlace {
  std::string link;
  Pose X_BT = Pose::Identity();
};
AntennaPlace TrueAntenna(const Antenna& own, const Antenna& other);

/// Signs of the axes of an inertial unit whose readings come with the wrong ones, `axis_flip`.
Vec3 AxisSigns(const Effects& effects);

}  // namespace tera
