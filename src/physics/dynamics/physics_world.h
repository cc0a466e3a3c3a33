#pragma once

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "core/motion.h"
#include "physics/description/machine_placement.h"
#include "physics/dynamics/site_walls.h"

namespace tera {

/// Something solid that machines collide with. Its pose is set from outside before each step
/// (static, or moved along a path); contact pushes machines, not the obstacle.
struct ObstacleBody {
  std::string name;
  std::vector<CollisionBox> collision;
  BodyState state;
  /// Height of its highest corner over the ground: running gear drives over what it can climb
  /// (ClimbHeight_m), and collides with what it cannot.
  double rise_m = std::numeric_limits<double>::infinity();
};

/// Multibody dynamics of all machines (Bullet btMultiBody, Featherstone), with obstacles and the
/// site's walls.
///
/// Frames  W, link frames B as in MachineModel.
/// Model   levers -> Actuation -> velocity motors limited in effort, with friction; running gears
///         turn against the soil's traction, I dw/dt = torque - traction * radius; the soil's
///         wrenches act on the links; carried soil adds its mass to the tool's link. Velocities
///         are those at the end of a step and poses follow them (semi-implicit), so that soil
///         forces given for the present pose act stably. Joints with cylinders are limited by
///         relief (see Hydraulics). Boxes of different machines, and of machines and obstacles
///         and walls, collide without bouncing; but links with running gear drive over obstacles
///         that it can climb, on which the ground bears them (see Soil::AddObstacle).
/// Omits   the reaction of a gear's inertia on its link, collision within one machine.
class PhysicsWorld {
 public:
  PhysicsWorld(const std::vector<MachinePlacement>& machines,
               const std::vector<ObstacleBody>& obstacles, double gravity_mps2,
               const WorldStart& start = {}, const SiteWalls& walls = {});
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
