#pragma once

#include <string>
#include <vector>

#include "render/scene.h"
#include "sim/scenario/scenario.h"

/// Implausible properties in a machine's description.

namespace tera {

/// Mass and size of a link.
struct LinkSize {
  std::string name;
  double mass_kg = 0;
  Vec3 size_m = Vec3::Zero();  ///< box along its axes around its visuals, collision shapes, tools
                               ///< and running gear; zero without any of these
};

/// One entry per link of the machine, in their order. `scene` has the link meshes.
std::vector<LinkSize> SizesOf(const ScenarioMachine& machine, const SceneModel& scene);

/// Doubts about the machine's description, one sentence each, which begins with its name.
///
/// Model   A body in a box has a radius of gyration of at most half the box's diagonal about any
///         axis through its centre of mass. About some axis it is at least a hundredth of that.
///         Links that are fixed together count as one body. No body and no drawn link is denser
///         than 25 t/m3 in its box; a machine is heavier than the air in its box. No link is longer
///         than 100 m. A revolute joint's limits lie within one turn either way; a joint with equal
///         limits has effort and velocity. A machine with a free base falls if it has no running
///         gear and no hull points.
std::vector<std::string> DoubtsOf(const ScenarioMachine& machine, const SceneModel& scene);

/// Doubts about the machine's drives, a part of DoubtsOf.
///
/// Model   No revolute joint covers its whole range in a fifth of a second. A joint holds its load
///         against gravity at the start. No driven joint without limits turns half of the mass
///         about a lying axis. The joint or gear of a lever has a rate and an effort. Running gear
///         reaches at most 30 m/s and below the boxes of its link, the "left" one is on the left,
///         and the gears are about the gauge apart. A shovel holds at most ten times the volume
///         that its profile and width enclose. A bucket's profile begins at the end far from the
///         pin, a blade's at its lower end.
std::vector<std::string> DrivesInDoubt(const MachinePlacement& placement);

/// Doubts about positions. Machines and obstacles are off the site, or a machine overlaps another
/// or an obstacle. Persons are faster than 12 m/s, other obstacles faster than 40 m/s. Sensors are
/// below the ground or more than 60 m from their link, or their angles in degrees are quarters of
/// pi.
std::vector<std::string> PlacesInDoubt(const Scenario& scenario);

}  // namespace tera
