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

/// True position of the antenna that feeds the receiver of `own`.
///
/// Frames  B the antenna's link.
/// Model   With `antenna_swap` on either antenna, it is the true mount of `other`; the noise stays
///         with the receiver. With `antenna_yaw` on either, both antennas rotate about the vertical
///         of B through the midpoint of their documented positions.
/// Omits   `antenna_yaw` for antennas on different links; phase centre variation with elevation.
struct AntennaPlace {
  std::string link;
  Pose X_BT = Pose::Identity();
};
AntennaPlace TrueAntenna(const Antenna& own, const Antenna& other);

/// The other antenna of a machine with exactly two antennas, for antenna_swap and antenna_yaw;
/// otherwise nullptr.
const SensorDescription* OtherAntenna(const SensorDescription& sensor,
                                      const std::vector<SensorDescription>& sensors);

}  // namespace tera
