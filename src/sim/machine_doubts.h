#pragma once

#include <string>
#include <vector>

#include "render/scene.h"
#include "sim/scenario/scenario.h"

/// Properties in a machine's description that no real machine has, for whoever checks it.

namespace tera {

/// Mass and size of a link, beside each other.
struct LinkSize {
  std::string name;
  double mass_kg = 0;
  Vec3 size_m = Vec3::Zero();  ///< of the box along its axes around what is shown, collides, digs
                               ///< and bears on the ground; zero where there is nothing of these
};

/// One for each link of the machine, in their order. `scene` shows it.
std::vector<LinkSize> SizesOf(const ScenarioMachine& machine, const SceneModel& scene);

/// Doubts about the machine's description, a sentence each that begins with its name.
///
/// Model   A body within a box has a radius of gyration of at most half the box's diagonal
///         about any axis through its centre of mass, and at least a hundredth of that about some
///         axis; links that are fixed together are one body. Neither such a body nor a link that
///         is drawn is denser than 25 t/m3 in its box, and a machine weighs more than the air in
///         the box around it. No link is longer than 100 m. A revolute joint's limits lie within a
///         turn either way; a joint whose limits are equal has effort and velocity. Without
///         running gear and hull points a machine whose base is free falls.
std::vector<std::string> DoubtsOf(const ScenarioMachine& machine, const SceneModel& scene);

/// Doubts about how the machine is driven, part of DoubtsOf.
///
/// Model   No revolute joint goes its whole way in a fifth of a second. A joint holds against
///         gravity what hangs on it at the start. No driven joint without limits turns half of the
///         mass about an axis that lies. A lever's joint or gear has a rate and an effort. Running
///         gear goes at most 30 m/s, "left" of it to the left, lies about its gauge apart and
///         reaches below the boxes of its link. A shovel holds at most ten times what its profile
///         and width enclose. The edge of one that holds soil is its profile's far end from the
///         pin, that of another the lower end.
std::vector<std::string> DrivesInDoubt(const MachinePlacement& placement);

/// Doubts about what stands where: machines and obstacles beside the site, a machine in the place
/// of another or of an obstacle, persons faster than 12 m/s and others faster than 40 m/s, sensors
/// below the ground or more than 60 m from their link, and mounts whose angles in degrees are
/// quarters of pi.
std::vector<std::string> PlacesInDoubt(const Scenario& scenario);

}  // namespace tera
