#pragma once

#include <string>
#include <vector>

#include "physics/description/machine.h"

namespace tera {

/// Points over a machine part that must stay out of unopened ground.
struct PartOutline {
  std::string part;
  int link = 0;
  std::vector<Vec3> points_B_m;
};

/// Outlines of the undercarriage, of every link above it with a collision box, and of the body
/// behind the cutting edge of each shovel that carries soil.
///
/// Model   undercarriage: the corners of the tracks' shoes and, mirrored above the sprockets'
///         height, those that touch when the machine lies on its side. Also the corners of boxes
///         that belong to no track. (A track's box is square where the track is round.) Other
///         links: their boxes' corners. Shovels: the floor, backwards from where the profile leaves
///         the edge.
/// Omits   links whose shovel carries nothing (a blade).
std::vector<PartOutline> OutlinesOf(const MachineModel& model);

}  // namespace tera
