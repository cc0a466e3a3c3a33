#pragma once

#include <optional>
#include <string>

#include "dataset/import/cloud/point_cloud.h"

namespace tera {

/// Steps in which a cloud's coordinates lie because the numbers of its file have too few digits.
struct CoarseSteps {
  char axis = 'x';
  double step_m = 0;
  std::string cause;  ///< with the remedy, for messages
};

/// The coarsest steps of x, y and z, where they exceed 0.02 m.
///
/// Model   LAS has them as its scale. Others have them where x and y went through single precision:
///         every coordinate is a float, and those of both axes lie as near to each other as floats
///         of their size can, which a regular grid's do not. Coordinates written with too few
///         digits have them too: steps of coordinates over 100 km, with more than three points at a
///         place.
/// Omits   clouds of a few points.
std::optional<CoarseSteps> FindCoarseSteps(const PointCloud& cloud);

}  // namespace tera
