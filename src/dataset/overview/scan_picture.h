#pragma once

#include <vector>

#include "dataset/overview/picture.h"

/// Images of lidar scans, coloured by kSemanticClasses.

namespace tera {

/// Radius within which nearly all points lie, seen from above.
double ShownRadius_m(const std::vector<LidarPoint>& points);

/// View from above. Forward (x) is up in the image, left (y) is left. Rings are 10 m apart. The
/// image extends to `radius_m` above and below its centre.
Picture DrawScanFromAbove(const std::vector<LidarPoint>& points, int width_px, int height_px,
                          double radius_m);
/// View from above with the radius ShownRadius_m.
Picture DrawScanFromAbove(const std::vector<LidarPoint>& points, int width_px, int height_px);

/// Perspective view from above, behind and to the right of the sensor. Stronger returns are
/// brighter.
Picture DrawScanFromBehind(const std::vector<LidarPoint>& points, int width_px, int height_px);

}  // namespace tera
