#pragma once

#include <string>

#include "core/motion.h"
#include "dataset/export/sensor_track.h"
#include "dataset/format/dataset_info.h"

namespace tera {

/// Motion of a body at one instant.
///
/// Frames  W world, B body.
struct BodyMotion {
  Pose X_WB = Pose::Identity();
  Vec3 v_W_mps = Vec3::Zero();
  Vec3 a_W_mps2 = Vec3::Zero();  ///< without gravity
  Vec3 w_B_radps = Vec3::Zero();
};

/// Motion of a body B from the poses of a sensor fixed to it.
///
/// Model   positions follow a parabola, rotations a steady turn, through poses half a window
///         earlier and later. The window is twice the interval of the poses, at least 20 ms, and
///         lies within the recording.
BodyMotion MotionAt(const SensorPoses& poses, const Pose& X_SB, TimeNs t_ns);

/// The 30 numbers of KITTI's raw data for an error-free inertial and satellite unit at B's origin,
/// x forward, y left and z up.
///
/// Model   latitude, longitude (deg), height above the ellipsoid; roll, pitch, yaw with R_WB =
///         Rz(yaw) Ry(pitch) Rx(roll); velocity to north and east, then forward, left and up, where
///         forward is level; specific force along B and along these; angular rate about B and about
///         these. Accuracies, satellites and modes are 0, the navigation status 4 (locked).
/// Source  Geiger et al. 2013, "Vision meets robotics: the KITTI dataset", and the `dataformat.txt`
///         of its raw data.
std::string OxtsRow(const BodyMotion& motion, const DatasetInfo& info);

}  // namespace tera
