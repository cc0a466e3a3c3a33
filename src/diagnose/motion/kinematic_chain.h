#pragma once

#include <optional>
#include <vector>

#include "physics/description/machine.h"

namespace tera {

/// The moving joints between the base and a link. Fixed transforms between them are folded into the
/// joints' frames.
///
/// Frames  B base; P parent frame of a joint (the child frame of the previous joint, B for the
///         first); J frame of the joint; L the link.
struct KinematicChain {
  struct Step {
    Pose X_PJ = Pose::Identity();
    Vec3 axis_J = Vec3::UnitZ();
    bool slides = false;
    int joint = 0;  ///< index in the machine model
    int place = 0;  ///< index among the joints whose motion is estimated
  };
  std::vector<Step> steps;
  Pose X_PL = Pose::Identity();  ///< fixed pose of the link in the child frame of the last joint
};

/// Longer chains are not supported.
inline constexpr int kMostJointsOfChain = 6;

/// The chain to a link. Empty if it has more than kMostJointsOfChain moving joints. `places` maps
/// each joint of the model to its index among the estimated joints; -1 keeps the joint at its
/// initial position.
std::optional<KinematicChain> ChainTo(const MachineModel& model, int link,
                                      const std::vector<int>& places);

}  // namespace tera
