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
  std::optional<CandidateLibrary> library;  ///< limits what is named
  JudgeOptions judge;
  int threads = 1;
};

/// A number of a mechanism in the mechanism's own unit.
struct FoundNumber {
  std::string name, unit;
  double value = 0, sigma = 0, documented = 0, tolerance = 0;
  bool is_beyond = false;
};

/// One mechanism of one target with its numbers.
struct SensorFinding : TargetMechanism {
  std::vector<FoundNumber> numbers;
  double gain = 0, p = 1;
  std::vector<TargetMechanism> rivals;  ///< not told apart from it
};

/// One measured number over the whole recording. Its residuals count over the scale that noise and
/// the motion's model error have together, times the noise: a blow weighs little.
struct ChannelError {
  std::string name, unit;
  double noise = 0, inflation = 1;
  double differences = 0;  ///< differences of successive residuals, as white noise would have
  double motion = 0;       ///< of an inertial unit: standard deviation of its measurements
  double tolerance = 0;    ///< of an error that stays as it is
  double rms_before = 0, rms_after = 0;  ///< with nothing free, with what was named free
};

/// The motion of a part of the recording.
struct EstimatedMotion {
  TimeNs start_ns = 0, end_ns = 0;  ///< of what was observed
  TimeNs spline_start_ns = 0;
  UniformSpline spline;
  Eigen::MatrixXd coefficients;

  Pose BaseAt(TimeNs t_ns) const;
  /// Place, roll, pitch and yaw of the base.
  Eigen::Matrix<double, kBaseNumbers, 1> BaseNumbersAt(TimeNs t_ns) const;
};

/// Diagnosis of a machine's sensors, which are compared with each other and with the motion that
/// they all imply.
struct SensorDiagnosis {
  std::vector<SensorFinding> findings;
  std::vector<SensorFinding> within_tolerance, untestable;
  std::vector<SensorFinding> unproven;  ///< GroupJudgement
  std::vector<std::vector<TargetMechanism>> not_told_apart;
  double left_to_gain = 0;                 ///< GroupJudgement
  std::vector<TargetMechanism> estimated;  ///< all that was free somewhere
  std::size_t candidates = 0;              ///< mechanisms of targets that might have been named
  std::vector<ChannelError> channels;
  std::vector<EstimatedMotion> motion;  ///< in the order of time
  /// Whether receivers and inertial units tell the base's place and heading.
  bool knows_base = false;
  std::vector<std::string> not_compared;
  int iterations = 0;
};

/// Estimates motion and parameters of all sensors together, and judges which of them lie beyond
/// their tolerances.
///
/// Model   first everything is fitted under a wide prior. This gives the noise, under a model no
///         narrower than any judged, and the point of linearisation. Axes of units that oppose the
///         motion are turned about and reported (OpposedAxes). Groups are judged there
///         (JudgeGroups). Everything is linearised again with the named groups free, and judged
///         once more.
SensorDiagnosis DiagnoseSensors(const DiagnosisInput& input, const Measurements& measured,
                                const SensorDiagnosisOptions& options, StageClock* clock);

}  // namespace tera
