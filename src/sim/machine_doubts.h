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
///         about any axis through its centre of mass; links that are fixed together are one body. A
///         body weighs less than a ball of osmium around its box, and a machine more than the air
///         in the box around it. No link is longer than 100 m. Without running gear and hull points
///         a machine whose base is free falls.
std::vector<std::string> DoubtsOf(const ScenarioMachine& machine, const SceneModel& scene);

}  // namespace tera
