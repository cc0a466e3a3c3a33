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

/// Poses of one body. Times increase strictly.
using Trajectory = std::vector<TimedPose>;

/// Rigid motion that aligns the world of the evaluated trajectory with that of the reference.
enum class Alignment {
  kNone,
  kSe2,  ///< yaw about z and a horizontal translation
  kSe3,  ///< rotation and translation
};

/// Interpolated pose. Returns nullopt outside the track, and between poses that are more than
/// `max_gap_ns` apart.
std::optional<Pose> PoseAt(const Trajectory& track, TimeNs t_ns, TimeNs max_gap_ns);

struct TrajectoryErrorOptions {
  Alignment alignment = Alignment::kNone;
  /// Interval d of the relative pose error.
  TimeNs relative_interval_ns = kNsPerSecond;
  /// Longest interval for interpolation.
  TimeNs max_gap_ns = kNsPerSecond;
};

struct ErrorStatistics {
  double rmse = 0, mean = 0, median = 0, max = 0;
};

/// Errors at one time of the reference.
struct PoseErrorSample {
  TimeNs t_ns = 0;
  double translation_m = 0, rotation_rad = 0;
};

/// Errors of a trajectory `b` (estimate or simulation) against a reference `a`.
///
/// Frames  W world of a, V world of b, B body; `X_WV` is the alignment.
/// Model   At each time of a, with b interpolated: E = X_WB_a^-1 X_WV X_VB_b. The absolute pose
///         error (APE) is |translation(E)| and angle(E). The relative pose error (RPE) over an
///         interval d uses F = (a_t^-1 a_(t+d))^-1 (b_t^-1 b_(t+d)), which does not depend on the
///         alignment. X_WV is a least-squares fit to the positions (Umeyama, scale 1). Path lengths
///         cover the common times. The final drift is F from the first to the last common time.
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
  std::vector<PoseErrorSample> ape;  ///< one per common time
  std::size_t rpe_count = 0;
};

/// Throws InputError if the trajectories have fewer than 3 common times.
TrajectoryError EvaluateTrajectory(const Trajectory& a, const Trajectory& b,
                                   const TrajectoryErrorOptions& options);

}  // namespace tera
