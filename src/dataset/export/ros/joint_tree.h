#pragma once

#include <string>
#include <vector>

#include "core/motion.h"

namespace tera {

/// How the links of a machine hang together, as far as transforms need it.
///
/// Frames  P parent link, J joint frame (X_PJ at position 0 is where the child's frame stands).
struct JointTree {
  enum class Motion { kNone, kTurns, kSlides };
  struct Joint {
    std::string name, parent, child;
    Motion motion = Motion::kNone;
    Pose X_PJ = Pose::Identity();
    Vec3 axis_J = Vec3::UnitZ();

    /// Pose of the child in its parent at a position in rad or m.
    Pose ChildInParent(double position) const {
      switch (motion) {
        case Motion::kNone:
          return X_PJ;
        case Motion::kTurns:
          return X_PJ * Eigen::AngleAxisd(position, axis_J);
        case Motion::kSlides:
          return X_PJ * Eigen::Translation3d(position * axis_J);
      }
      return X_PJ;
    }
  };
  std::string machine, root;
  bool fixed_base = false;
  std::vector<Joint> joints;
};

}  // namespace tera
