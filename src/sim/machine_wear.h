#pragma once

#include <vector>

#include "physics/description/machine.h"
#include "render/wear.h"
#include "soil/site/site.h"

/// Where on machines and obstacles their wear is.

namespace tera {

/// The wear of each link of a machine.
///
/// Model   shovels are in the soil; the link that carries one is as far from the soil as its points
///         are from the shovel's joint, along the line from the link's own joint to it; all others
///         as far as they are above the ground with all joints at zero. A shovel has a cutting
///         edge.
/// Omits   arms that reach into a pit, and how the machine has really worked.
std::vector<NodeWear> WearOfLinks(const MachineModel& machine, const Wear& wear,
                                  const Vec3& soil_albedo);

/// Of parts that lie in the soil as a whole: tracks, wheels.
NodeWear WearInSoil(const Wear& wear, const Vec3& soil_albedo);

/// Of what stands on the ground with its frame's origin.
NodeWear WearOnGround(const Wear& wear, const Vec3& soil_albedo);

/// Of the rocker and the coupler that turn a shovel, and of cylinders: as far from the soil
/// everywhere as an arm's usually are.
NodeWear WearOfLinkage(const Wear& wear, const Vec3& soil_albedo);
NodeWear WearOfCylinder(const Wear& wear, const Vec3& soil_albedo);

/// Whether work leaves its marks on obstacles of that class: not on people, rocks and plants.
bool IsWorn(SemanticClass label);

/// Of the dry soil that is seen at a place, beyond the site that of its nearest border.
Vec3 SoilAlbedoAt(const Site& site, const Vec2& xy_W_m);

}  // namespace tera
