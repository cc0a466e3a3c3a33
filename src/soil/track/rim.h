#pragma once

#include <optional>
#include <vector>

#include "core/types/ground_tools.h"

namespace tera {

/// The rim of a rigid wheel: a part of a cylinder about its axle.
///
/// Frames  B the frame of the gear's link; W. Angles are those from straight down in B, positive to
///         the front.
/// Model   Patches of a gear that lie on one circle, to both sides of straight down, are a wheel;
///         how many they are does not matter.
struct Rim {
  Vec3 axle_B_m = Vec3::Zero();
  double radius_m = 0, width_m = 0;
  double first_rad = 0, last_rad = 0;  ///< the part that is there

  /// A place on the rim, in W.
  struct Point {
    Vec3 p_W_m;
    Vec3 n_W;       ///< outward
    Vec3 along_W;   ///< in which the rim moves relative to B when it rolls forward
    Vec3 across_W;  ///< to the left
  };
  Point At(double angle_rad, double across_m, const Pose& X_WB) const;

  /// Where the rim stands over a place on the ground.
  struct Over {
    double z_m;
    double angle_rad, across_m;
  };
  /// Its lower side over (x, y), if it is there.
  std::optional<Over> Above(const Vec2& p_W_m, const Pose& X_WB) const;
};

/// The wheels of a gear, and which of its patches they are made of.
struct GearRims {
  std::vector<Rim> rims;
  std::vector<bool> has_patch;  ///< for each patch, whether it belongs to one of them
};
GearRims FindRims(const RunningGear& gear);

}  // namespace tera
