#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/motion.h"
#include "dataset/ros/delta_can.h"

namespace tera {

/// The kinematic tree of a machine for transforms, with its tool and levers for its own messages.
///
/// Frames  P parent link, J joint frame (X_PJ is the child's frame at position 0), L the link that
///         carries the tool, T the tool: the middle of its cutting edge, axes of L.
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
  struct Tool {
    std::string link;
    Pose X_LT = Pose::Identity();
  };
  std::optional<Tool> tool;             ///< the first shovel that can carry soil
  std::vector<ros::NamedLever> levers;  ///< in the order of commands.csv
};

}  // namespace tera
