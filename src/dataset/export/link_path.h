#pragma once

#include <string>
#include <vector>

#include "dataset/export/record_stream.h"
#include "dataset/export/ros/joint_tree.h"

namespace tera {

/// A joint between a machine's root and a link, and its column in a table of positions.
struct PathStep {
  JointTree::Joint joint;
  std::size_t column = 0;  ///< index, for a movable joint
};

/// The joints from the root to a link. If there is no path, or the table lacks a joint's position,
/// `lacks` names the missing item.
std::vector<PathStep> PathToLink(const std::string& link, const JointTree& tree,
                                 const std::vector<std::string>& columns, std::string* lacks);

/// The link L in the root link R, from a row of the table.
Pose X_RL(const std::vector<PathStep>& path, const Record& row);

}  // namespace tera
