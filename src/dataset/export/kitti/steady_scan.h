#pragma once

#include "core/motion.h"
#include "core/types/measurement.h"

namespace tera {

/// A scan as a lidar that stood still at `t_ns` would have taken it: each point, which is in the
/// sensor's frame at the time of its own ray, in that of `t_ns`.
///
/// Omits   the motion of what was seen.
std::vector<LidarPoint> SteadyScan(const LidarScan& scan, const PoseTrack& X_WS, TimeNs t_ns);

/// KITTI's bytes of points: x, y, z in m and intensity as 32-bit floats, low byte first.
std::string VelodyneBytes(const std::vector<LidarPoint>& points);

}  // namespace tera
