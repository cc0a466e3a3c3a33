#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "dataset/export/nuscenes/nuscenes_rig.h"
#include "dataset/export/picture/rectifier.h"

namespace tera {

/// Content of the exported files of one sensor. The recording and the sensor must outlive the
/// object.
class SensorFrames {
 public:
  SensorFrames(const Recording& recording, const NuScenesSensor& sensor);

  // For cameras: PNG of the rectified image. For a lens without distortion, the recording's own
  // PNG. Throws InputError if the image is missing or its size differs from the lens.
  std::string PictureBytes(TimeNs t_ns) const;

  // For lidars: points of a scan, motion-corrected to the middle of the scan, `t_ns`.
  std::vector<LidarPoint> Points(TimeNs t_ns) const;
  std::vector<Vec3> InWorld(const std::vector<LidarPoint>& points, TimeNs t_ns) const;
  /// One byte per point: the category of its class, or the ego category if its instance is in
  /// `own`. Throws InputError for an unknown class.
  std::string Categories(const std::vector<LidarPoint>& points, TimeNs t_ns,
                         const std::set<std::uint16_t>& own) const;

 private:
  const Recording& recording_;
  const NuScenesSensor& sensor_;
  std::optional<Rectifier> rectifier_;
};

/// Encodes x, y, z in m, intensity in [0, 255] and ring of each point as 32-bit floats, low byte
/// first.
std::string NuScenesPointBytes(const std::vector<LidarPoint>& points);

}  // namespace tera
