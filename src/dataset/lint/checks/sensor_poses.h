#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dataset/lint/lint_job.h"

namespace tera {

/// A pose of a recording, with optional velocities.
struct PoseRow {
  int line = 0;
  TruthPose pose;
};

/// Readable rows of a channel of poses.
std::vector<PoseRow> ReadPoses(const LintJob& job, const std::string& channel);

/// A pose between two rows, by Interpolate; nothing outside the rows or in a gap of half a second.
std::optional<Pose> PoseAt(const std::vector<PoseRow>& poses, TimeNs t_ns);

/// Checks a row's position for places.far. No machine works 100 km from its origin, where the plane
/// of east and north is 780 m above the ground.
void CheckNear(LintJob* job, const std::string& channel, int line, const Vec3& p_W_m);

/// Known poses of a sensor.
struct SensorPoses {
  std::vector<PoseRow> poses;  ///< sensor poses; machine poses if `of_root`
  bool of_root = false;        ///< the mount is unknown, or joints lie between it and the root
};

/// Finds the poses of a sensor; nothing without poses.
///
/// Model   X_WS of truth/<machine>/sensors/<sensor>.csv; else X_WL of the link in
///         truth/<machine>/links/ and the mount of sensor.yaml; else the machine's pose, with the
///         mount if scenario.yaml has the link as the machine's root.
std::optional<SensorPoses> FindSensorPoses(const LintJob& job, const std::string& sensor);

}  // namespace tera
