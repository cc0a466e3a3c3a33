#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/motion.h"
#include "dataset/ros/delta_can.h"

namespace tera {

/// Kinematic tree of a machine for ROS transforms. It also holds the tool and the levers for
/// machine-specific messages.
///
/// Frames  P parent link; J joint frame, where X_PJ is the child's pose at position 0; L the link
///         that carries the tool; T tool frame at the middle of the cutting edge, with the axes of
///         L.
struct JointTree {
  enum class Motion { kNone, kTurns, kSlides };
  struct Joint {
    std::string name, parent, child;
    Motion motion = Motion::kNone;
    Pose X_PJ = Pose::Identity();
    Vec3 axis_J = Vec3::UnitZ();

    /// Pose of the child link in its parent at a joint position in rad or m.
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
  std::optional<Tool> tool;             ///< the first shovel with a capacity for soil
  std::vector<ros::NamedLever> levers;  ///< in the order of commands.csv
};

}  // namespace tera
