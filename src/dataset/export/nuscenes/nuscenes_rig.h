#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dataset/export/export_job.h"
#include "dataset/export/sensor_track.h"
#include "dataset/format/sensor_sheet.h"

namespace tera {

/// A camera or lidar of a machine for nuScenes.
///
/// Frames  F frame of the measurements: the optical frame of a camera (x right, y down, z forward),
///         or the sensor frame of a lidar (x forward, y left, z up).
struct NuScenesSensor {
  std::string path;                ///< such as "digger/front"
  std::string channel;             ///< such as "CAM_FRONT"
  std::optional<CameraLens> lens;  ///< only for a camera
  bool has_boxes = false;          ///< only for a camera: boxes were recorded
  TimeNs delay_ns = 0;       ///< only for a lidar: time from the first ray of a scan to its middle
  std::vector<TimeNs> t_ns;  ///< times of the frames; for a lidar, the middle of each scan
  SensorPoses poses;         ///< poses of the sensor frame S
  Pose X_SF = Pose::Identity();

  bool is_camera() const { return lens.has_value(); }
  Pose X_WF(TimeNs at_ns) const { return poses.X_WS.At(at_ns) * X_SF; }
};

/// A machine with cameras or lidars. Frame B is its root link.
struct NuScenesRig {
  std::string machine;
  PoseTrack X_WB;
  std::vector<NuScenesSensor> sensors;  ///< lidars first
};

/// All machines that have a usable sensor: a lidar, or a camera with colour images and a lens that
/// can be rectified. Sensors without frames are left out.
///
/// Throws  InputError if the pose of a sensor or of its machine is unknown, or if two sensors of a
///         machine have the same channel name.
std::vector<NuScenesRig> ReadNuScenesRigs(ExportJob* job);

}  // namespace tera
