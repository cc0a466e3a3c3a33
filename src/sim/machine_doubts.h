#pragma once

#include <string>
#include <vector>

#include "render/scene.h"
#include "sim/scenario/scenario.h"

/// Warnings about implausible values in a machine's description.

namespace tera {

struct LinkSize {
  std::string name;
  double mass_kg = 0;
  /// Bounding box of its visuals, collision shapes, tools and running gear, in the link's axes.
  /// Zero if it has none of these.
  Vec3 size_m = Vec3::Zero();
};

/// One entry per link, in the order of the model. `scene` provides the link meshes.
std::vector<LinkSize> SizesOf(const ScenarioMachine& machine, const SceneModel& scene);

/// Warnings about a machine's description, one sentence each. A sentence begins with the machine's
/// name.
///
/// Model   the expectations are:
///         - A machine with a free base has running gear or hull points; otherwise it would fall.
///         - No link is longer than 100 m. If one is, the checks below are skipped.
///         - Consider a body's largest radius of gyration about its centre of mass. It is at most
///           half the diagonal of the body's bounding box, and at least a hundredth of that. Links
///           that are fixed together count as one body.
///         - The centre of mass is within a diagonal of the bounding box.
///         - No body and no link with visuals is denser than 25 t/m3 in its box. The machine is
///           heavier than the air in its box.
///         - Limits of a revolute joint are within one turn either way. A joint with equal limits
///           has effort and velocity.
std::vector<std::string> DoubtsOf(const ScenarioMachine& machine, const SceneModel& scene);

/// Warnings about a machine's drives; a part of DoubtsOf.
///
/// Model   the expectations are:
///         - A revolute joint needs more than a fifth of a second for its whole range.
///         - A joint can hold its load against gravity at the start.
///         - A driven joint without limits and with a horizontal axis turns less than half of the
///           mass. (A slew axis in the wrong direction would turn more.)
///         - The joint or running gear of a lever has a rate and an effort.
///         - Running gear reaches at most 30 m/s and extends below the boxes of its link. Gear
///           named "left" is on the left. The gears are about the gauge apart.
///         - A shovel's capacity is at most ten times the volume that its profile and width
///           enclose. The profile of a bucket begins at the end far from the pin, that of a blade
///           at the lower end.
std::vector<std::string> DrivesInDoubt(const MachinePlacement& placement);

/// Warnings about positions: machines or obstacles off the site; a machine that overlaps another
/// machine or an obstacle; persons faster than 12 m/s and other obstacles faster than 40 m/s;
/// sensors below the ground or more than 60 m from their link; sensor angles in degrees that equal
/// multiples of pi/4, as if given in radians.
std::vector<std::string> PlacesInDoubt(const Scenario& scenario);

}  // namespace tera
