#pragma once

#include <vector>

#include "physics/description/machine.h"
#include "render/wear.h"
#include "soil/site/site.h"

/// Distribution of wear on machines and obstacles.

namespace tera {

/// The wear of each link of a machine.
///
/// Model   shovels are in the soil. On the link that carries a shovel, the distance from the soil
///         counts from the shovel's joint, along the line from the link's own joint. On all other
///         links it is the height above the ground with all joints at zero. A shovel has a cutting
///         edge.
/// Omits   arms that reach into a pit, and the machine's actual work.
std::vector<NodeWear> WearOfLinks(const MachineModel& machine, const Wear& wear,
                                  const Vec3& soil_albedo);

/// Wear of parts that are wholly in the soil: tracks, wheels.
NodeWear WearInSoil(const Wear& wear, const Vec3& soil_albedo);

/// Wear of objects whose frame's origin lies on the ground.
NodeWear WearOnGround(const Wear& wear, const Vec3& soil_albedo);

/// Wear of a shovel's rocker and coupler, and of cylinders: uniformly at an arm's usual distance
/// from the soil.
NodeWear WearOfLinkage(const Wear& wear, const Vec3& soil_albedo);
NodeWear WearOfCylinder(const Wear& wear, const Vec3& soil_albedo);

/// Whether obstacles of that class show wear; people, rocks and plants do not.
bool IsWorn(SemanticClass label);

/// Colour of the visible dry soil at a place; off the site, that of its nearest border.
Vec3 SoilAlbedoAt(const Site& site, const Vec2& xy_W_m);

}  // namespace tera
