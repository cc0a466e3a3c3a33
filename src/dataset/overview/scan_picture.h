#pragma once

#include <vector>

#include "dataset/overview/picture.h"

/// Lidar scans for display, in the colours of kSemanticClasses.

namespace tera {

/// From above: x forward is up, y left, with rings each 10 m.
Picture DrawScanFromAbove(const std::vector<LidarPoint>& points, int width_px, int height_px);

/// In perspective, from above, behind and to the right of the sensor; brighter for stronger
/// returns.
Picture DrawScanFromBehind(const std::vector<LidarPoint>& points, int width_px, int height_px);

}  // namespace tera
