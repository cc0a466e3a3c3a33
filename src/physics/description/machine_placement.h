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
  std::vector<double> q_rad;     ///< initial joint positions, one per joint, within limits
};

/// Inputs of one machine for a step.
struct MachineInput {
  std::vector<double> levers;  ///< one per lever of the model, clamped to -1..+1
  SoilReaction soil;
};

/// Seed of all random numbers of the motion, and index of the first step.
struct WorldStart {
  std::uint64_t seed = 1;
  std::int64_t step = 0;
};

}  // namespace tera
