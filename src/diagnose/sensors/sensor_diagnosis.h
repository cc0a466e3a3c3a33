#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/stage_clock.h"
#include "diagnose/sensors/judge_groups.h"
#include "diagnose/sensors/sensor_problem.h"

namespace tera {

struct SensorDiagnosisOptions {
  KnownPlace place;
  std::optional<CandidateLibrary> library;  ///< restricts which mechanisms can be named
  JudgeOptions judge;
  int threads = 1;
};

/// A number of a mechanism, in the mechanism's unit.
struct FoundNumber {
  std::string name, unit;
  double value = 0, sigma = 0, documented = 0, tolerance = 0;
  bool is_beyond = false;
};

struct SensorFinding : TargetMechanism {
  std::vector<FoundNumber> numbers;
  double gain = 0, p = 1;
  std::vector<TargetMechanism> rivals;  ///< mechanisms that explain the recording about as well
};

/// Error of one measured number over the recording. Residuals are scaled by noise / (noise and
/// model error together), so that an impact weighs little.
struct ChannelError {
  std::string name, unit;
  double noise = 0, inflation = 1;
  double differences = 0;                ///< noise deviation by successive differences of residuals
  double motion = 0;                     ///< inertial units: standard deviation of the measurements
  double tolerance = 0;                  ///< tolerance of a constant error
  double rms_before = 0, rms_after = 0;  ///< RMS with no group free; with the named groups free
};

/// The estimated motion of a part of the recording.
struct EstimatedMotion {
  TimeNs start_ns = 0, end_ns = 0;
  TimeNs spline_start_ns = 0;
  UniformSpline spline;
  Eigen::MatrixXd coefficients;

  Pose BaseAt(TimeNs t_ns) const;
  /// Position, roll, pitch and yaw of the base.
  Eigen::Matrix<double, kBaseNumbers, 1> BaseNumbersAt(TimeNs t_ns) const;
};

/// Diagnosis of a machine's sensors. They are compared with each other through the motion that all
/// of them imply.
struct SensorDiagnosis {
  std::vector<SensorFinding> findings;
  std::vector<SensorFinding> within_tolerance, untestable;
  std::vector<SensorFinding> unproven;  ///< GroupJudgement::unproven
  std::vector<std::vector<TargetMechanism>> not_told_apart;
  double left_to_gain = 0;                 ///< GroupJudgement::left_to_gain
  std::vector<TargetMechanism> estimated;  ///< every mechanism and target that was estimated
  std::size_t candidates = 0;              ///< number of mechanisms of targets that can be named
  std::vector<ChannelError> channels;
  std::vector<EstimatedMotion> motion;  ///< ordered by time
  /// True if receivers and inertial units determine position and heading of the base.
  bool knows_base = false;
  std::vector<std::string> not_compared;
  int iterations = 0;
};

/// Estimates motion and parameters of all sensors together, and decides which sensors lie beyond
/// their tolerances.
///
/// Model   all parameters are fitted under a wide prior. This fit gives the noise and the point of
///         linearisation. No judged model is more flexible, so its noise contains no error that a
///         judged mechanism could explain. Axes of units that oppose the motion are reversed and
///         reported (OpposedAxes). Groups are judged at this point (JudgeGroups). With the named
///         groups free, the problem is linearised and judged again.
SensorDiagnosis DiagnoseSensors(const DiagnosisInput& input, const Measurements& measured,
                                const SensorDiagnosisOptions& options, StageClock* clock);

}  // namespace tera
