#pragma once

#include "core/motion.h"
#include "core/types/measurement.h"

namespace tera {

/// A scan corrected for the sensor's motion: each point moves from the sensor's frame at its own
/// ray to the frame at `t_ns`.
///
/// Omits   the motion of the targets.
std::vector<LidarPoint> SteadyScan(const LidarScan& scan, const PoseTrack& X_WS, TimeNs t_ns);

/// KITTI's bytes of points: x, y, z in m and intensity as 32-bit floats, low byte first.
std::string VelodyneBytes(const std::vector<LidarPoint>& points);

}  // namespace tera
