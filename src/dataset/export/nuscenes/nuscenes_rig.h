#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dataset/export/export_job.h"
#include "dataset/export/sensor_track.h"
#include "dataset/format/sensor_sheet.h"

namespace tera {

/// A camera or a lidar of a machine in nuScenes' format.
///
/// Frames  F the frame of the measurements: a camera's optical frame (x right, y down, z forward),
///         or a lidar's own frame (x forward, y left, z up).
struct NuScenesSensor {
  std::string path;                ///< "digger/front"
  std::string channel;             ///< "CAM_FRONT"
  std::optional<CameraLens> lens;  ///< for a camera
  bool has_boxes = false;          ///< for a camera
  TimeNs delay_ns = 0;             ///< for a scan: from its first ray to its middle
  std::vector<TimeNs> t_ns;        ///< times of its frames, for scans their middle
  SensorPoses poses;               ///< poses of its own frame S
  Pose X_SF = Pose::Identity();

  bool is_camera() const { return lens.has_value(); }
  Pose X_WF(TimeNs at_ns) const { return poses.X_WS.At(at_ns) * X_SF; }
};

/// A machine with cameras or lidars. B is its root link.
struct NuScenesRig {
  std::string machine;
  PoseTrack X_WB;
  std::vector<NuScenesSensor> sensors;  ///< lidars come first
};

/// All machines with sensors: lidars, and cameras with colour and a lens with a pinhole equivalent.
/// Sensors without frames are left out; each machine has at least one sensor.
///
/// Throws  InputError if the pose of a sensor or its machine is unknown, or if two sensors of a
///         machine have the same channel.
std::vector<NuScenesRig> ReadNuScenesRigs(ExportJob* job);

}  // namespace tera
