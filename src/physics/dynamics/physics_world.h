#pragma once

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "core/motion.h"
#include "physics/description/machine_placement.h"
#include "physics/dynamics/body_contact.h"
#include "physics/dynamics/site_walls.h"

namespace tera {

/// A solid obstacle for machines. The caller sets its pose for each step, static or along a path.
/// Contacts push machines but not the obstacle.
struct ObstacleBody {
  std::string name;
  std::vector<CollisionBox> collision;
  BodyState state;
  /// Height of its highest corner above the ground. Running gear drives over obstacles that it can
  /// climb (ClimbHeight_m) and collides with higher ones.
  double rise_m = std::numeric_limits<double>::infinity();
};

/// Multibody dynamics of all machines (Bullet btMultiBody, Featherstone), with obstacles and the
/// walls of the site.
///
/// Frames  W, link frames B as in MachineModel.
/// Model   Drives: levers -> Actuation -> velocity motors with limited effort and friction. Relief
///         valves limit joints with cylinders (see Hydraulics). Running gears turn against the
///         traction of the soil: I dw/dt = torque - traction * radius.
///         Soil: its wrenches act on the links; carried soil adds its mass to the link of the tool.
///         The integration is semi-implicit: poses follow the velocities at the end of a step. So
///         soil forces computed for the present pose act stably.
///         Collisions: boxes of a machine collide, without bouncing, with other machines, obstacles
///         and walls. Links with running gear drive over obstacles that they can climb; the ground
///         bears them there (see Soil::AddObstacle).
/// Omits   The reaction of a gear's inertia on its link, collision within one machine.
class PhysicsWorld {
 public:
  PhysicsWorld(const std::vector<MachinePlacement>& machines,
               const std::vector<ObstacleBody>& obstacles, double gravity_mps2,
               const WorldStart& start = {}, const SiteWalls& walls = {});
  ~PhysicsWorld();

  /// Advances by `dt_s`. `inputs` has one entry per machine. `obstacles` has the state of each
  /// obstacle at the end of the step.
  void Step(const std::vector<MachineInput>& inputs, const std::vector<BodyState>& obstacles,
            double dt_s);

  const std::vector<MachineState>& machines() const;

  /// Contacts of the last step, each pair of bodies once. Gear that drives over an obstacle has
  /// none with it.
  const std::vector<BodyContact>& contacts() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tera
