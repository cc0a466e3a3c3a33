#pragma once

#include <string>
#include <vector>

#include "dataset/export/record_stream.h"
#include "dataset/export/ros/joint_tree.h"

namespace tera {

/// A joint on the path from a machine's root to a link, with its column in a table of joint
/// positions.
struct PathStep {
  JointTree::Joint joint;
  std::size_t column = 0;  ///< column index; only for a movable joint
};

/// Joints from the root to a link, in order. If the tree has no such link or the table lacks a
/// position, `lacks` receives the name of the missing item.
std::vector<PathStep> PathToLink(const std::string& link, const JointTree& tree,
                                 const std::vector<std::string>& columns, std::string* lacks);

/// Pose of the link L in the root link R, with joint positions from a row of the table.
Pose X_RL(const std::vector<PathStep>& path, const Record& row);

}  // namespace tera
