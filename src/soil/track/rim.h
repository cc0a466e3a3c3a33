#pragma once

#include <optional>
#include <vector>

#include "core/types/ground_tools.h"

namespace tera {

/// The rim of a rigid wheel: a part of a cylinder about its axle.
///
/// Frames  B the frame of the gear's link; W. Angles are from straight down in B, positive to the
///         front.
/// Model   Patches of a gear form a wheel if they lie on one circle, on both sides of straight
///         down. Their number has no effect.
struct Rim {
  Vec3 axle_B_m = Vec3::Zero();
  double radius_m = 0, width_m = 0;
  double first_rad = 0, last_rad = 0;  ///< range of angles that exists

  /// A point on the rim, in W.
  struct Point {
    Vec3 p_W_m;
    Vec3 n_W;       ///< outward normal
    Vec3 along_W;   ///< motion of the rim relative to B when it rolls forward
    Vec3 across_W;  ///< to the left
  };
  Point At(double angle_rad, double across_m, const Pose& X_WB) const;

  /// The point of the rim above a position on the ground.
  struct Over {
    double z_m;
    double angle_rad, across_m;
  };
  /// The lower side of the rim above (x, y); empty if there is none.
  std::optional<Over> Above(const Vec2& p_W_m, const Pose& X_WB) const;
};

/// The wheels of a gear, and the patches that form them.
struct GearRims {
  std::vector<Rim> rims;
  std::vector<bool> has_patch;  ///< for each patch: it belongs to a wheel
};
GearRims FindRims(const RunningGear& gear);

}  // namespace tera
