#pragma once

#include "core/motion.h"
#include "core/types/measurement.h"

namespace tera {

/// Corrects a scan for the motion of the sensor (deskewing). Each point is transformed from the
/// sensor frame at the time of its ray to the sensor frame at `t_ns`.
///
/// Omits   the motion of the targets.
std::vector<LidarPoint> SteadyScan(const LidarScan& scan, const PoseTrack& X_WS, TimeNs t_ns);

/// Encodes points for KITTI: x, y, z in m and intensity as 32-bit floats, low byte first.
std::string VelodyneBytes(const std::vector<LidarPoint>& points);

}  // namespace tera
