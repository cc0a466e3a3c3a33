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

/// Position of the antenna whose signal the receiver of `own` obtains.
///
/// Frames  B the antenna's link.
/// Model   `antenna_swap` on either antenna: the true mount of `other`; the noise stays with the
///         receiver. `antenna_yaw` on either: both rotate about the vertical of B through the
///         midpoint of their documented positions.
/// Omits   antennas on different links for `antenna_yaw`; phase centre variation with elevation.
struct AntennaPlace {
  std::string link;
  Pose X_BT = Pose::Identity();
};
AntennaPlace TrueAntenna(const Antenna& own, const Antenna& other);

/// The other antenna of a two-antenna machine, for antenna_swap and antenna_yaw; otherwise nullptr.
const SensorDescription* OtherAntenna(const SensorDescription& sensor,
                                      const std::vector<SensorDescription>& sensors);

}  // namespace tera
