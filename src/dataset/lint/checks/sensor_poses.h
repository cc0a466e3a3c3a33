#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dataset/lint/lint_job.h"

namespace tera {

/// A pose of a recording, and the velocities where it has them.
struct PoseRow {
  int line = 0;
  TruthPose pose;
};

/// Rows of a channel of poses that can be read.
std::vector<PoseRow> ReadPoses(const LintJob& job, const std::string& channel);

/// A pose between two rows, by Interpolate; nothing outside of them or where half a second is
/// missing.
std::optional<Pose> PoseAt(const std::vector<PoseRow>& poses, TimeNs t_ns);

/// Holds a place of a channel's row to places.far: no machine works 100 km from its origin, beyond
/// which the plane of east and north is 780 m above the ground besides.
void CheckNear(LintJob* job, const std::string& channel, int line, const Vec3& p_W_m);

/// What is known of where a sensor was.
struct SensorPoses {
  std::vector<PoseRow> poses;  ///< of the sensor; of its machine where `of_root`
  bool of_root = false;        ///< its mount is not known, or joints lie between it and the root
};

/// Model  X_WS of truth/<machine>/sensors/<sensor>.csv; else X_WL of the link in
///        truth/<machine>/links/ and the mount of sensor.yaml; else the machine's pose, and the
///        mount where scenario.yaml has the link as the machine's root. Nothing where there are no
///        poses.
std::optional<SensorPoses> FindSensorPoses(const LintJob& job, const std::string& sensor);

}  // namespace tera
