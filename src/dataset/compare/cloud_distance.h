#pragma once

#include <vector>

#include "core/types/measurement.h"

namespace tera {

/// Distances of the points of one cloud to another cloud, in metres.
struct CloudDistances {
  std::vector<double> to_point_m;    ///< to the nearest point
  std::vector<double> to_surface_m;  ///< to the local surface plane, for points that have one
                                     ///< defined
};

/// Distances of points to the points and the local surface of another cloud. Both clouds are in the
/// same frame.
///
/// Model   The local surface is the least-squares plane through the 32 nearest points of `other`.
///         It is used only if the points form no line: the second principal deviation is at least a
///         fifth of the first. They must also be flat: the third is at most a tenth of the second.
///         If there are more than 10 000 points, every n-th is used.
/// Omits   surfaces with sparse beams, such as distant ground: there the nearest points are on one
///         beam and form a line.
/// Source  point to plane: Chen and Medioni 1992, "Object modelling by registration of multiple
///         range images".
CloudDistances DistancesFrom(const std::vector<LidarPoint>& other,
                             const std::vector<LidarPoint>& points);

/// Deviation of one range from a flat surface.
struct PlaneDeviation {
  double range_m = 0, deviation_m = 0;
};

/// Deviations of ranges from the flat surfaces of their own cloud, in the sensor frame.
///
/// Model   Every n-th point is used, so that at most 500 are. The deviation is measured along the
///         ray, from the least-squares plane through the 200 nearest points. A patch counts only if
///         it is flat and forms no line, as in DistancesFrom. The ray must be within 60 deg of the
///         normal of the plane.
/// Omits   Surface relief below a tenth of the patch counts as deviation. Patches with more noise
///         than that are skipped.
std::vector<PlaneDeviation> DeviationsOnPlanes(const std::vector<LidarPoint>& points);

}  // namespace tera
