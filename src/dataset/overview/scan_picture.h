#pragma once

#include <vector>

#include "dataset/overview/picture.h"

/// Lidar scans for display, in the colours of kSemanticClasses.

namespace tera {

/// Radius that shows nearly all points from above.
double ShownRadius_m(const std::vector<LidarPoint>& points);

/// From above: x forward is up, y left, with rings each 10 m; to `radius_m` above and below.
Picture DrawScanFromAbove(const std::vector<LidarPoint>& points, int width_px, int height_px,
                          double radius_m);
/// The same with ShownRadius_m.
Picture DrawScanFromAbove(const std::vector<LidarPoint>& points, int width_px, int height_px);

/// In perspective, from above, behind and to the right of the sensor; brighter for stronger
/// returns.
Picture DrawScanFromBehind(const std::vector<LidarPoint>& points, int width_px, int height_px);

}  // namespace tera
