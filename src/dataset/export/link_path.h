#pragma once

#include <string>
#include <vector>

#include "dataset/export/record_stream.h"
#include "dataset/export/ros/joint_tree.h"

namespace tera {

/// A joint on the way from a machine's root to a link, and where a table has its position.
struct PathStep {
  JointTree::Joint joint;
  std::size_t column = 0;  ///< of a joint that moves
};

/// The way from the root to a link. Where there is none, or the table lacks the position of a joint
/// on it, `lacks` says what is missing.
std::vector<PathStep> PathToLink(const std::string& link, const JointTree& tree,
                                 const std::vector<std::string>& columns, std::string* lacks);

/// The link L in the root link R, by the positions of a row of the table.
Pose X_RL(const std::vector<PathStep>& path, const Record& row);

}  // namespace tera
