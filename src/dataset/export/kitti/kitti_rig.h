#pragma once

#include <string>

#include "dataset/export/export_job.h"
#include "dataset/export/picture/rectifier.h"
#include "dataset/export/sensor_track.h"
#include "dataset/format/sensor_sheet.h"

namespace tera {

/// The lidar that --lidar names, else the first. Throws InputError where there is none.
std::string ChosenLidar(const ExportJob& job);

/// The optical frame C in the frame S of a camera or of another sensor: z of C is x of S, x of C is
/// -y of S.
Pose OpticalAxesInSensor();

/// The lidar of an export, where it was, and on what it is mounted.
struct KittiLidar {
  std::string path;
  TimeNs period_ns = 0;  ///< of a scan
  Pose X_PS;             ///< in the link that carries it
  SensorPoses poses;
};

/// ChosenLidar. Throws InputError where there is none, or where
/// its rate, its mounting or its place is not known.
KittiLidar ReadKittiLidar(ExportJob* job);

/// The camera and the lidar of an export.
///
/// Frames  W world, C the camera's optical frame (x right, y down, z forward), S the lidar's (x
///         forward, y left, z up), P the link that carries the lidar. These are KITTI's camera,
///         Velodyne and GPS/IMU.
struct KittiRig {
  std::string camera;
  CameraLens lens;
  SensorPoses camera_poses;
  KittiLidar lidar;

  Pose X_WC(TimeNs t_ns) const;
  Pose X_WS(TimeNs t_ns) const { return lidar.poses.X_WS.At(t_ns); }
};

/// The camera that --camera names, else the first, and the lidar. Throws InputError as above, and
/// where the lens is not known or is one that no pinhole can stand for.
KittiRig ReadKittiRig(ExportJob* job);

}  // namespace tera
