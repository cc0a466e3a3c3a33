#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dataset/lint/lint_job.h"

namespace tera {

/// A recorded pose. Velocities are optional.
struct PoseRow {
  int line = 0;
  TruthPose pose;
};

std::vector<PoseRow> ReadPoses(const LintJob& job, const std::string& channel);

/// Interpolated pose. Returns nullopt outside the rows and in gaps longer than half a second.
std::optional<Pose> PoseAt(const std::vector<PoseRow>& poses, TimeNs t_ns);

/// Checks a position for the rule places.far. At 100 km from the origin, the tangent plane is 780 m
/// above the ground, so a position there is an error.
void CheckNear(LintJob* job, const std::string& channel, int line, const Vec3& p_W_m);

/// Poses from which the motion of a sensor is known.
struct SensorPoses {
  std::vector<PoseRow> poses;  ///< poses of the sensor, or of the machine's root link if `of_root`
  bool of_root = false;  ///< the mount is unknown, or movable joints lie between root link and
                         ///< sensor
};

/// Finds the poses of a sensor; nullopt if there are none.
///
/// Model   In order of preference: truth/<machine>/sensors/<sensor>.csv; the link's poses in
///         truth/<machine>/links/ with the mount in sensor.yaml; the machine's poses. In the last
///         case the mount is applied only if scenario.yaml shows that the link is the machine's
///         root.
std::optional<SensorPoses> FindSensorPoses(const LintJob& job, const std::string& sensor);

}  // namespace tera
