#pragma once

#include <vector>

#include "dataset/overview/picture.h"

/// Lidar scans drawn for people to look at, in the colours of kSemanticClasses.

namespace tera {

/// From above: x forward is up, y left, with rings each 10 m.
Picture DrawScanFromAbove(const std::vector<LidarPoint>& points, int width_px, int height_px);

/// In perspective, from a place above, behind and to the right of the sensor; brighter where the
/// return is stronger.
Picture DrawScanFromBehind(const std::vector<LidarPoint>& points, int width_px, int height_px);

}  // namespace tera
