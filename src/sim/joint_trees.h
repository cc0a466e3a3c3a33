#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "dataset/export/ros/joint_tree.h"
#include "sim/scenario/scenario.h"

namespace tera {

std::vector<JointTree> JointTreesOf(const Scenario& scenario);

/// Joint trees of a simulated recording, from its scenario. Empty for a real recording. `moved` as
/// in LoadRecordedScenario.
///
/// Throws  InputError if the scenario or one of its files cannot be read or has changed.
std::vector<JointTree> RecordedJointTrees(const std::filesystem::path& recording,
                                          const std::vector<std::string>& moved);

}  // namespace tera
