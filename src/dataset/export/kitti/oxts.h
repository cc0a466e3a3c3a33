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
  Vec3 a_W_mps2 = Vec3::Zero();  ///< coordinate acceleration, without gravity
  Vec3 w_B_radps = Vec3::Zero();
};

/// Motion of a body B, from the poses of a sensor fixed to it.
///
/// Model   Fits three poses: at `t_ns`, and half a window before and after it. Position follows a
///         parabola and rotation a constant turn rate. The window is twice the interval of the
///         poses, at least 20 ms, and is moved to lie within the recording.
BodyMotion MotionAt(const SensorPoses& poses, const Pose& X_SB, TimeNs t_ns);

/// The 30 numbers of a KITTI oxts row, for an error-free inertial and satellite unit at B's origin:
/// x forward, y left, z up.
///
/// Model   In order: latitude, longitude (deg), ellipsoidal height; roll, pitch, yaw with R_WB =
///         Rz(yaw) Ry(pitch) Rx(roll); velocity north, east, then forward, left, up in the levelled
///         frame; specific force along B's axes, then along the levelled axes; angular rate about
///         B's axes, then about the levelled axes. Accuracies, satellites and modes are 0. The
///         navigation status is 4 (locked).
/// Source  Geiger et al. 2013, "Vision meets robotics: the KITTI dataset", and the `dataformat.txt`
///         of its raw data.
std::string OxtsRow(const BodyMotion& motion, const DatasetInfo& info);

}  // namespace tera
