#pragma once

#include <optional>

#include "diagnose/diagnosis_input.h"
#include "diagnose/sensors/path_lag.h"

namespace tera {

/// Path of a receiver's antenna by all sources with another clock than the receiver. It is in the
/// plane, from the base's first place and heading; times in seconds since `zero_ns`.
///
/// Model   the base by running gear, at rest where it is fixed, else by recorded poses; the antenna
///         in it by the encoders of the joints before its link.
/// Omits   slip and leaning of the base; inertial units.
///
/// None where a joint before the link moves without an encoder, or no source shows the base's
/// motion.
std::optional<PlanarPath> AntennaPath(const DiagnosisInput& input, const Measurements& measured,
                                      const SensorDescription& receiver, TimeNs zero_ns);

}  // namespace tera
