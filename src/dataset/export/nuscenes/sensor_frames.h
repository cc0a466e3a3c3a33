#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "dataset/export/nuscenes/nuscenes_rig.h"
#include "dataset/export/picture/rectifier.h"

namespace tera {

/// File contents of a sensor's frames. The recording and the sensor must outlive it.
class SensorFrames {
 public:
  SensorFrames(const Recording& recording, const NuScenesSensor& sensor);

  // Cameras.
  // The PNG of a rectified picture; for a pinhole lens the recording's own bytes. Throws InputError
  // if it is missing or its size differs from the lens.
  std::string PictureBytes(TimeNs t_ns) const;

  // Lidars.
  // A scan's points, motion-corrected to its middle, `t_ns`.
  std::vector<LidarPoint> Points(TimeNs t_ns) const;
  std::vector<Vec3> InWorld(const std::vector<LidarPoint>& points, TimeNs t_ns) const;
  /// One byte per point: the category of its class, or the ego category for the instances `own`.
  /// Throws InputError for an unknown class.
  std::string Categories(const std::vector<LidarPoint>& points, TimeNs t_ns,
                         const std::set<std::uint16_t>& own) const;

 private:
  const Recording& recording_;
  const NuScenesSensor& sensor_;
  std::optional<Rectifier> rectifier_;
};

/// x, y, z in m, intensity from 0 to 255 and ring of each point, as 32-bit floats, low byte first.
std::string NuScenesPointBytes(const std::vector<LidarPoint>& points);

}  // namespace tera
