#include "dataset/export/link_path.h"

#include <fmt/format.h>

#include <algorithm>

namespace tera {

std::vector<PathStep> PathToLink(const std::string& link, const JointTree& tree,
                                 const std::vector<std::string>& columns, std::string* lacks) {
  std::vector<PathStep> path;
  for (std::string at = link; at != tree.root;) {
    const auto joint = std::find_if(tree.joints.begin(), tree.joints.end(),
                                    [&](const JointTree::Joint& j) { return j.child == at; });
    if (joint == tree.joints.end()) {
      *lacks = fmt::format("its machine has no link '{}'", at);
      return {};
    }
    PathStep step{*joint};
    if (joint->motion != JointTree::Motion::kNone) {
      const bool slides = joint->motion == JointTree::Motion::kSlides;
      const auto column =
          std::find(columns.begin(), columns.end(), joint->name + (slides ? "_m" : "_rad"));
      if (column == columns.end()) {
        *lacks = fmt::format("joints.csv has no joint '{}'", joint->name);
        return {};
      }
      step.column = static_cast<std::size_t>(column - columns.begin());
    }
    path.insert(path.begin(), step);
    at = joint->parent;
  }
  return path;
}

Pose X_RL(const std::vector<PathStep>& path, const Record& row) {
  Pose X = Pose::Identity();
  for (const PathStep& step : path) {
    const bool moves = step.joint.motion != JointTree::Motion::kNone;
    X = X * step.joint.ChildInParent(moves ? row.values[step.column] : 0);
  }
  return X;
}

}  // namespace tera
