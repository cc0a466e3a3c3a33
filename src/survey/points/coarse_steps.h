#pragma once

#include <optional>
#include <string>

#include "dataset/import/cloud/point_cloud.h"

namespace tera {

/// Coordinate steps of a cloud whose file stores too few digits.
struct CoarseSteps {
  char axis = 'x';
  double step_m = 0;
  std::string cause;  ///< with the remedy, for messages
};

/// The coarsest steps of x, y and z if they exceed 0.02 m.
///
/// Model   For LAS, the steps are its scale. Elsewhere, x and y may have passed through single
///         precision. Then every coordinate is a float. The least distances on both axes equal the
///         spacing of floats of that size, unlike those of a regular grid. Coordinates over 100 km
///         with more than three points at a place were written with too few digits.
/// Omits   clouds of a few points.
std::optional<CoarseSteps> FindCoarseSteps(const PointCloud& cloud);

}  // namespace tera
