#pragma once

#include <optional>

#include "diagnose/diagnosis_input.h"
#include "diagnose/sensors/path_lag.h"

namespace tera {

/// Path of a receiver's antenna in the plane, from sources that do not share the receiver's clock.
/// Frame: initial position and heading of the base. Times: seconds since `zero_ns`.
///
/// Model   base motion from running gear, a fixed base, or else recorded poses. The antenna's
///         position in the base follows from encoders of the joints before its link.
/// Omits   slip, roll and pitch of the base; inertial units.
///
/// Empty if a joint with a lever before the link has no encoder, or if no source shows the motion
/// of the base.
std::optional<PlanarPath> AntennaPath(const DiagnosisInput& input, const Measurements& measured,
                                      const SensorDescription& receiver, TimeNs zero_ns);

}  // namespace tera
