#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/motion.h"

namespace tera {

/// Colour of undisturbed ground from an image of the site.
///
/// Frames  W; vertex (i, j) lies at low_W_m + cell_m (i, j). Beyond the grid its border extends.
/// Model   initial albedo and height, bilinear between vertices. Undisturbed ground shows the
///         image's colour. The soil's own colour replaces it as the ground loosens, and as its
///         height departs from the start by 2 to 6 cm.
/// Omits   the lidar's reflectance, which is the soil's.
struct GroundPaint {
  Vec2 low_W_m = Vec2::Zero();
  double cell_m = 1;
  int nx = 0, ny = 0;
  std::vector<Eigen::Vector3f> albedo;  ///< linear, row-major, x fastest
  std::vector<float> start_m;           ///< initial height

  /// Colour at (x, y) for ground of height `height_m` and looseness `loose` (0 to 1). `soil` is the
  /// soil's own colour.
  Vec3 Over(const Vec3& soil, double x_m, double y_m, double height_m, double loose) const;
};

}  // namespace tera
