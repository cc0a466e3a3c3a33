#pragma once

#include <optional>
#include <vector>

#include "physics/description/machine.h"

namespace tera {

/// The joints between the base and a link, those that do not move folded into the others.
///
/// Frames  B base; of each joint P its parent (the child of the one before, at first B), J its own
///         frame; L the link.
struct KinematicChain {
  struct Step {
    Pose X_PJ = Pose::Identity();
    Vec3 axis_J = Vec3::UnitZ();
    bool slides = false;
    int joint = 0;  ///< its index in the model
    int place = 0;  ///< among the joints with an estimated motion
  };
  std::vector<Step> steps;
  Pose X_PL = Pose::Identity();  ///< of the link in the last joint's child, fixed
};

/// More moving joints between the base and a link are not looked at.
inline constexpr int kMostJointsOfChain = 6;

/// The chain to a link; `places` has the place of each of the model's joints among those of which
/// the motion is estimated, -1 where it rests as at first. None where it is too long.
std::optional<KinematicChain> ChainTo(const MachineModel& model, int link,
                                      const std::vector<int>& places);

}  // namespace tera
