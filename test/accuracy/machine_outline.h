#pragma once

#include <string>
#include <vector>

#include "physics/description/machine.h"

namespace tera {

/// Points all over a part of a machine that has no business in unopened ground.
struct PartOutline {
  std::string part;
  int link = 0;
  std::vector<Vec3> points_B_m;
};

/// Outlines of the undercarriage, of every link above it that has a collision box, and of what
/// follows the cutting edge of each shovel that carries soil.
///
/// Model   undercarriage: the corners of the tracks' shoes below and, mirrored, above the
///         sprockets' height, which have a say when the machine lies on its side, and those of the
///         boxes that are no track's. (A track's box is square where the track is round.) Other
///         links: their boxes' corners. Shovels: floor and back from where the profile leaves the
///         edge.
/// Omits   links whose shovel carries nothing (a blade).
std::vector<PartOutline> OutlinesOf(const MachineModel& model);

}  // namespace tera
