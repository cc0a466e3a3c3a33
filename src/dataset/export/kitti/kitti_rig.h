#pragma once

#include <string>

#include "dataset/export/export_job.h"
#include "dataset/export/picture/rectifier.h"
#include "dataset/export/sensor_track.h"
#include "dataset/format/sensor_sheet.h"

namespace tera {

/// The lidar that --lidar names, else the first. Throws InputError if there is none.
std::string ChosenLidar(const ExportJob& job);

/// The optical frame C in the frame S of a camera or another sensor: z of C is x of S, x of C is -y
/// of S.
Pose OpticalAxesInSensor();

/// The exported lidar with its poses and its mounting.
struct KittiLidar {
  std::string path;
  TimeNs period_ns = 0;  ///< duration of a scan
  Pose X_PS;             ///< in the link that carries it
  SensorPoses poses;
};

/// Reads ChosenLidar. Throws InputError if there is none, or if its rate, mounting or pose is
/// unknown.
KittiLidar ReadKittiLidar(ExportJob* job);

/// The exported camera and lidar.
///
/// Frames  W world, C the camera's optical frame (x right, y down, z forward), S the lidar's (x
///         forward, y left, z up), P the link that carries the lidar. C, S and P are KITTI's
///         camera, Velodyne and GPS/IMU.
struct KittiRig {
  std::string camera;
  CameraLens lens;
  SensorPoses camera_poses;
  KittiLidar lidar;

  Pose X_WC(TimeNs t_ns) const;
  Pose X_WS(TimeNs t_ns) const { return lidar.poses.X_WS.At(t_ns); }
};

/// Reads the camera that --camera names, else the first, and the lidar. Throws InputError as above,
/// and if the lens is unknown or has no pinhole equivalent.
KittiRig ReadKittiRig(ExportJob* job);

}  // namespace tera
