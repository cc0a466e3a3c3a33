#pragma once

#include <string>
#include <vector>

#include "core/motion.h"
#include "core/types/effects.h"
#include "sensors/sensor.h"

namespace tera {

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

/// The other antenna of a machine that has two, for antenna_swap and antenna_yaw; else nullptr.
const SensorDescription* OtherAntenna(const SensorDescription& sensor,
                                      const std::vector<SensorDescription>& sensors);

}  // namespace tera
