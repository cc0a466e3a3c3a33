#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/ground_tools.h"
#include "core/motion.h"
#include "physics/machine.h"

namespace tera {

/// A machine placed in the world.
struct MachinePlacement {
  std::string name;
  MachineModel model;
  Pose X_WB = Pose::Identity();  ///< pose of the root link at the start
  std::vector<double> q_rad;     ///< joint angles at the start, one for each joint, within limits
};

/// Something solid that machines collide with. Its pose is set from outside before each step
/// (static, or moved along a path); contact pushes machines, not the obstacle.
struct ObstacleBody {
  std::string name;
  std::vector<CollisionBox> collision;
  BodyState state;
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

/// Multibody dynamics of all machines (Bullet btMultiBody, Featherstone), with obstacles.
///
/// Frames  W, link frames B as in MachineModel.
/// Model   levers -> Actuation -> velocity motors limited in effort, with friction; running gears
///         turn against the soil's traction, I dw/dt = torque - traction * radius; the soil's
///         wrenches act on the links; carried soil adds its mass to the tool's link. Velocities
///         are those at the end of a step and poses follow them (semi-implicit), so that soil
///         forces given for the present pose act stably. Joints with cylinders are limited by
///         relief (see Hydraulics). Boxes of different machines, and of
///         machines and obstacles, collide without bouncing.
/// Omits   the reaction of a gear's inertia on its link, collision within one machine.
class PhysicsWorld {
 public:
  PhysicsWorld(const std::vector<MachinePlacement>& machines,
               const std::vector<ObstacleBody>& obstacles, double gravity_mps2,
               const WorldStart& start = {});
  ~PhysicsWorld();

  /// Advances by `dt_s`. `inputs` one for each machine, `obstacles` where the obstacles are at the
  /// end of the step, one for each obstacle.
  void Step(const std::vector<MachineInput>& inputs, const std::vector<BodyState>& obstacles,
            double dt_s);

  const std::vector<MachineState>& machines() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tera
