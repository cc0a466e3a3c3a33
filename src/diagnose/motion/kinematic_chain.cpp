#include "diagnose/motion/kinematic_chain.h"

#include <algorithm>

namespace tera {

std::optional<KinematicChain> ChainTo(const MachineModel& model, int link,
                                      const std::vector<int>& places) {
  std::vector<std::size_t> way;
  while (link > 0) {
    way.push_back(static_cast<std::size_t>(link) - 1);
    link = model.joints[way.back()].parent;
  }
  std::reverse(way.begin(), way.end());
  KinematicChain chain;
  for (const std::size_t j : way) {
    const Joint& joint = model.joints[j];
    const Pose X_PJ = chain.X_PL * joint.X_PJ;
    if (joint.type == JointType::kFixed || places[j] < 0) {
      chain.X_PL = X_PJ * JointMotion(joint, joint.initial_rad);
      continue;
    }
    chain.steps.push_back({X_PJ, joint.axis_J.normalized(), joint.type == JointType::kPrismatic,
                           static_cast<int>(j), places[j]});
    chain.X_PL = Pose::Identity();
  }
  if (chain.steps.size() > static_cast<std::size_t>(kMostJointsOfChain)) return std::nullopt;
  return chain;
}

}  // namespace tera
