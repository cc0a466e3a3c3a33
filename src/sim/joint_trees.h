#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "dataset/export/ros/joint_tree.h"
#include "sim/scenario/scenario.h"

namespace tera {

/// How the machines of a scenario hang together.
std::vector<JointTree> JointTreesOf(const Scenario& scenario);

/// Of a simulated recording, from the scenario that it was made from; of a real one, none. `moved`
/// as of LoadRecordedScenario. Throws InputError where the scenario or one of its files cannot be
/// read or is another one than was recorded.
std::vector<JointTree> RecordedJointTrees(const std::filesystem::path& recording,
                                          const std::vector<std::string>& moved);

}  // namespace tera
