#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/motion.h"

namespace tera {

/// Colour of ground that is as it was at the start, where a picture of the site tells it.
///
/// Frames  W; vertex (i, j) lies at low_W_m + cell_m (i, j). Beyond the grid its border goes on.
/// Model   albedo and height at the start, bilinear between vertices. The picture holds where the
///         ground is undisturbed: it gives way to the soil's own colour as the ground is loosened,
///         and as its height departs from the start by 2 to 6 cm.
/// Omits   the lidar's reflectance, which is the soil's.
struct GroundPaint {
  Vec2 low_W_m = Vec2::Zero();
  double cell_m = 1;
  int nx = 0, ny = 0;
  std::vector<Eigen::Vector3f> albedo;  ///< linear, row-major, x fastest
  std::vector<float> start_m;           ///< height at the start

  /// The colour at (x, y), where the ground is `height_m` high and `loose` (0 to 1); `soil` is the
  /// soil's own.
  Vec3 Over(const Vec3& soil, double x_m, double y_m, double height_m, double loose) const;
};

}  // namespace tera
