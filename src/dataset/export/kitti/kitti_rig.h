#pragma once

#include <string>

#include "dataset/export/export_job.h"
#include "dataset/export/picture/rectifier.h"
#include "dataset/export/sensor_track.h"
#include "dataset/format/sensor_sheet.h"

namespace tera {

/// The lidar named by --lidar, or else the first. Throws InputError if there is none.
std::string ChosenLidar(const ExportJob& job);

/// Rotation from optical axes C to the axes of a sensor S: z of C is x of S, and x of C is -y of S.
Pose OpticalAxesInSensor();

/// The exported lidar, its poses and its mounting.
struct KittiLidar {
  std::string path;
  TimeNs period_ns = 0;  ///< duration of a scan
  Pose X_PS;             ///< pose in the link that carries the lidar
  SensorPoses poses;
};

/// Reads ChosenLidar. Throws InputError if there is none, or if its rate, mounting or pose is
/// unknown.
KittiLidar ReadKittiLidar(ExportJob* job);

/// The exported camera and lidar.
///
/// Frames  W world; C optical frame of the camera (x right, y down, z forward); S lidar (x forward,
///         y left, z up); P the link that carries the lidar. C, S and P correspond to KITTI's
///         camera, Velodyne and GPS/IMU.
struct KittiRig {
  std::string camera;
  CameraLens lens;
  SensorPoses camera_poses;
  KittiLidar lidar;

  Pose X_WC(TimeNs t_ns) const;
  Pose X_WS(TimeNs t_ns) const { return lidar.poses.X_WS.At(t_ns); }
};

/// Reads the lidar, and the camera named by --camera or else the first. Throws InputError as
/// ReadKittiLidar does, and if the lens is unknown or cannot be rectified.
KittiRig ReadKittiRig(ExportJob* job);

}  // namespace tera
