#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/motion.h"

namespace tera {

/// Colour of undisturbed ground, taken from an image of the site.
///
/// Frames  W. Vertex (i, j) lies at low_W_m + cell_m (i, j). Outside the grid the values of its
///         border apply.
/// Model   initial albedo and height, bilinear between vertices. Undisturbed ground has the colour
///         of the image. It blends into the soil's own colour as the ground loosens. It also blends
///         as the height departs from the initial height: not at all at 2 cm, completely at 6 cm.
/// Omits   the reflectance for lidars, which remains that of the soil.
struct GroundPaint {
  Vec2 low_W_m = Vec2::Zero();
  double cell_m = 1;
  int nx = 0, ny = 0;
  std::vector<Eigen::Vector3f> albedo;  ///< linear, row-major, x fastest
  std::vector<float> start_m;           ///< initial height

  /// Colour at (x, y) of ground with this height and looseness (0 to 1). `soil` is the soil's own
  /// colour.
  Vec3 Over(const Vec3& soil, double x_m, double y_m, double height_m, double loose) const;
};

}  // namespace tera
