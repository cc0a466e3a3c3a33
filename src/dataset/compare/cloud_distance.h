#pragma once

#include <vector>

#include "core/types/measurement.h"

namespace tera {

/// Distances of the points of one cloud from another, in metres.
struct CloudDistances {
  std::vector<double> to_point_m;    ///< to the nearest point of the other
  std::vector<double> to_surface_m;  ///< to the plane of its surface, where it has one
};

/// Distances of points from the points and surfaces of another cloud, in one frame.
///
/// Model   surface: the plane of least squares through the 32 points of `other` that are nearest.
///         It is judged only where these are no line (second principal deviation at least a fifth
///         of the first) and flat (third at most a tenth of the second). Of more than 10 000 points
///         every n-th is taken.
/// Omits   surfaces whose beams hit them too far apart, as ground far away: the nearest points are
///         those of one beam, a line.
/// Source  point to plane: Chen and Medioni 1992, "Object modelling by registration of multiple
///         range images".
CloudDistances DistancesFrom(const std::vector<LidarPoint>& other,
                             const std::vector<LidarPoint>& points);

/// Departure of one range from a flat surface.
struct PlaneDeviation {
  double range_m = 0, deviation_m = 0;
};

/// Departures of ranges from the flat surfaces of their own cloud, in the sensor's frame.
///
/// Model   of at most 500 points, every n-th: along the ray, from the plane of least squares
///         through the 200 nearest points, where these are broad and flat as for DistancesFrom and
///         the ray is within 60 deg of its normal.
/// Omits   relief below a tenth of the patch, which counts as deviation; noise above it, whose
///         patches are not judged.
std::vector<PlaneDeviation> DeviationsOnPlanes(const std::vector<LidarPoint>& points);

}  // namespace tera
