#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/motion.h"

namespace tera {

struct TimedPose {
  TimeNs t_ns = 0;
  Pose X_WB = Pose::Identity();
};

/// Poses of one body, times strictly increasing.
using Trajectory = std::vector<TimedPose>;

/// Alignment of the world of the evaluated trajectory with that of the reference.
enum class Alignment {
  kNone,
  kSe2,  ///< yaw about z and a horizontal shift
  kSe3,  ///< rotation and shift
};

/// The interpolated pose between two poses at most the gap apart; nothing outside the track.
std::optional<Pose> PoseAt(const Trajectory& track, TimeNs t_ns, TimeNs max_gap_ns);

struct TrajectoryErrorOptions {
  Alignment alignment = Alignment::kNone;
  /// Interval of the relative pose error.
  TimeNs relative_interval_ns = kNsPerSecond;
  /// Largest interval for interpolation.
  TimeNs max_gap_ns = kNsPerSecond;
};

struct ErrorStatistics {
  double rmse = 0, mean = 0, median = 0, max = 0;
};

/// Error at one time of the reference.
struct PoseErrorSample {
  TimeNs t_ns = 0;
  double translation_m = 0, rotation_rad = 0;
};

/// Errors of a trajectory `b` (estimate, simulation) against a reference `a`.
///
/// Frames  W world of a, V world of b, B body; `X_WV` is the alignment.
/// Model   at each time of a, with b interpolated: E = X_WB_a^-1 X_WV X_VB_b. Absolute pose error
///         (APE): |translation(E)|, angle(E). Relative pose error (RPE) over an interval d: F =
///         (a_t^-1 a_(t+d))^-1 (b_t^-1 b_(t+d)), which no alignment changes. X_WV by least squares
///         on the positions (Umeyama, scale 1). Path lengths cover the common times; the final
///         drift is F from the first common time to the last.
/// Omits   scale; the rotation about a straight path, which positions do not determine.
/// Source  Sturm et al. 2012, "A benchmark for the evaluation of RGB-D SLAM systems"; Zhang and
///         Scaramuzza 2018, "A tutorial on quantitative trajectory evaluation for visual(-inertial)
///         odometry"; Umeyama 1991.
struct TrajectoryError {
  Pose X_WV = Pose::Identity();
  ErrorStatistics ape_translation_m, ape_rotation_rad;
  ErrorStatistics rpe_translation_m, rpe_rotation_rad;
  double path_length_a_m = 0, path_length_b_m = 0;
  double final_drift_m = 0, final_drift_rad = 0;
  std::vector<PoseErrorSample> ape;  ///< one for each common time
  std::size_t rpe_count = 0;
};

/// Throws InputError if the trajectories have fewer than 3 common times.
TrajectoryError EvaluateTrajectory(const Trajectory& a, const Trajectory& b,
                                   const TrajectoryErrorOptions& options);

}  // namespace tera
