#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "dataset/export/nuscenes/nuscenes_rig.h"
#include "dataset/export/picture/rectifier.h"

namespace tera {

/// What the files of a sensor's frames hold. The recording and the sensor outlive it.
class SensorFrames {
 public:
  SensorFrames(const Recording& recording, const NuScenesSensor& sensor);

  // Of a camera.
  /// The PNG of a picture as a pinhole would have taken it; the recording's own bytes where the
  /// lens is one. Throws InputError where it is missing or has another size than the lens.
  std::string PictureBytes(TimeNs t_ns) const;

  // Of a lidar.
  /// A scan's points as if all had been taken in its middle, `t_ns`.
  std::vector<LidarPoint> Points(TimeNs t_ns) const;
  std::vector<Vec3> InWorld(const std::vector<LidarPoint>& points, TimeNs t_ns) const;
  /// A byte for each point: the category of its class, or of the machine itself where it is of one
  /// of the instances `own`. Throws InputError where a class is none.
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
