#pragma once

#include <optional>
#include <string>

#include "dataset/import/cloud/point_cloud.h"

namespace tera {

/// Resolution of coordinates in a file that stores too few digits.
struct CoarseSteps {
  char axis = 'x';
  double step_m = 0;
  std::string cause;  ///< cause and remedy, for messages
};

/// The coarsest resolution among x, y and z, if it exceeds 0.02 m.
///
/// Model   For LAS, the resolution is the scale in the header. In other files, x and y may have
///         been converted to single precision: then every coordinate is a float, and the least
///         distance on both axes equals the spacing of floats of that size. A regular grid does not
///         have this spacing. Coordinates above 100 km with more than three points per place were
///         written with too few digits.
/// Omits   clouds of a few points.
std::optional<CoarseSteps> FindCoarseSteps(const PointCloud& cloud);

}  // namespace tera
