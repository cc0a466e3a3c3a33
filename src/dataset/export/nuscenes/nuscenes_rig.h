#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dataset/export/export_job.h"
#include "dataset/export/sensor_track.h"
#include "dataset/format/sensor_sheet.h"

namespace tera {

/// A camera or a lidar of a machine, as nuScenes has it.
///
/// Frames  F the frame of the measurements: a camera's optical frame (x right, y down, z forward),
///         of a lidar its own (x forward, y left, z up).
struct NuScenesSensor {
  std::string path;                ///< "digger/front"
  std::string channel;             ///< "CAM_FRONT"
  std::optional<CameraLens> lens;  ///< of a camera
  bool has_boxes = false;          ///< of a camera
  TimeNs delay_ns = 0;             ///< of a scan: from its first ray to its middle
  std::vector<TimeNs> t_ns;        ///< of its frames; of scans the middle
  SensorPoses poses;               ///< of its own frame S
  Pose X_SF = Pose::Identity();

  bool is_camera() const { return lens.has_value(); }
  Pose X_WF(TimeNs at_ns) const { return poses.X_WS.At(at_ns) * X_SF; }
};

/// A machine with cameras or lidars. B is its root link.
struct NuScenesRig {
  std::string machine;
  PoseTrack X_WB;
  std::vector<NuScenesSensor> sensors;  ///< lidars before cameras
};

/// All machines with lidars or with cameras that have colour and a lens that a pinhole can stand
/// for, as far as they have frames; each has at least one.
///
/// Throws InputError where the place of a sensor or its machine is not known, or where two sensors
/// of a machine would have one channel.
std::vector<NuScenesRig> ReadNuScenesRigs(ExportJob* job);

}  // namespace tera
