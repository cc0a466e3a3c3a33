#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diagnose/measurements.h"
#include "diagnose/motion/starting_motion.h"
#include "diagnose/sensors/sensor_parameters.h"

namespace tera {

/// Prior knowledge of a machine's location.
struct KnownPlace {
  std::optional<Pose> start;  ///< initial pose of the base
  GroundHeight ground;        ///< empty if the ground is unknown
};

/// The motion problem of a machine, and the table of its sensors' parameters.
struct SensorProblem {
  MotionProblem motion;
  ParameterTable table;
  TimeNs start_ns = 0;                    ///< start of the first segment
  std::vector<std::string> not_compared;  ///< sensors left out, with the reason
};

/// Builds the problem from measurements.
///
/// Model   observations come from: inertial units; receivers with their documented fix; encoders of
///         joints before these sensors; recorded poses; travel and standstill of running gear;
///         known ground. Segments are about 10 s long. A recording is cut into at least eight
///         segments, as long as each lasts at least 4 s.
/// Omits   rates of encoders; fixes worse than documented; joints behind all units and antennas.
SensorProblem MakeSensorProblem(const DiagnosisInput& input, const Measurements& measured,
                                const KnownPlace& place);

}  // namespace tera
