#pragma once

#include <optional>

#include "diagnose/diagnosis_input.h"
#include "diagnose/sensors/path_lag.h"

namespace tera {

/// Where the antenna of a receiver went by all that has another clock than the receiver: in the
/// plane, from the place and heading at which the base began; times in seconds since `zero_ns`.
///
/// Model   the base by running gear, at rest where it is fixed, else by recorded poses; the antenna
///         in it by the encoders of the joints before its link.
/// Omits   slip and leaning of the base; inertial units. None where a joint before the link moves
///         without an encoder, or nothing says how the base moved.
std::optional<PlanarPath> AntennaPath(const DiagnosisInput& input, const Measurements& measured,
                                      const SensorDescription& receiver, TimeNs zero_ns);

}  // namespace tera
