#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/motion.h"
#include "core/types/ground_tools.h"
#include "physics/description/machine.h"

namespace tera {

/// A machine placed in the world.
struct MachinePlacement {
  std::string name;
  MachineModel model;
  Pose X_WB = Pose::Identity();  ///< pose of the root link at the start
  std::vector<double> q_rad;     ///< joint angles at the start, one for each joint, within limits
};

/// What acts on one machine during a step.
struct MachineInput {
  std::vector<double> levers;  ///< -1..+1, one for each lever of the model; beyond that, clamped
  SoilReaction soil;
};

/// The seed of everything random in the motion, and the time of the first step, in steps.
struct WorldStart {
  std::uint64_t seed = 1;
  std::int64_t step = 0;
};

}  // namespace tera
