#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diagnose/measurements.h"
#include "diagnose/motion/starting_motion.h"
#include "diagnose/sensors/sensor_parameters.h"

namespace tera {

/// Knowledge of a machine's place beside its measurements.
struct KnownPlace {
  std::optional<Pose> start;  ///< of the base at first
  GroundHeight ground;        ///< empty where it is not known
};

/// The problem of a machine's motion and its sensors' parameters.
struct SensorProblem {
  MotionProblem motion;
  ParameterTable table;
  TimeNs start_ns = 0;                    ///< of the first segment
  std::vector<std::string> not_compared;  ///< sensors that are not in it, and why
};

/// The problem of the measurements.
///
/// Model   inertial units, receivers with their documented fix, encoders of joints on the way to
///         these, recorded poses, travel and stillness of running gear, known ground. Segments of
///         about ten seconds, at least eight where the recording is long enough.
/// Omits   rates of encoders; fixes worse than documented; joints beyond all units and antennas.
SensorProblem MakeSensorProblem(const DiagnosisInput& input, const Measurements& measured,
                                const KnownPlace& place);

}  // namespace tera
