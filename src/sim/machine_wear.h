#pragma once

#include <vector>

#include "physics/description/machine.h"
#include "render/wear.h"
#include "soil/site/site.h"

/// Wear marks of machines and obstacles: where dust, mud, scratches and rust appear.

namespace tera {

/// Wear of each link of a machine.
///
/// Model   shovels are in the soil and have a cutting edge. The link that carries a shovel (the
///         arm) touches the soil at the shovel's joint. The distance of its points from the soil
///         grows linearly from there to the link's own joint. On all other links the distance is
///         the height above the ground with all joints at zero.
/// Omits   arms that reach into a pit, and the machine's actual work.
std::vector<NodeWear> WearOfLinks(const MachineModel& machine, const Wear& wear,
                                  const Vec3& soil_albedo);

/// Wear of parts that are completely in the soil: tracks, wheels.
NodeWear WearInSoil(const Wear& wear, const Vec3& soil_albedo);

/// Wear of objects whose origin lies on the ground, z up.
NodeWear WearOnGround(const Wear& wear, const Vec3& soil_albedo);

/// Wear of a bucket's rocker and coupler, and of cylinders. The distance from the soil is constant
/// over the part.
NodeWear WearOfLinkage(const Wear& wear, const Vec3& soil_albedo);
NodeWear WearOfCylinder(const Wear& wear, const Vec3& soil_albedo);

/// Whether obstacles of this class can show wear. People, rocks and plants cannot.
bool IsWorn(SemanticClass label);

/// Colour of the dry soil at a place of the surface. A place off the site has the colour of the
/// nearest place on the border.
Vec3 SoilAlbedoAt(const Site& site, const Vec2& xy_W_m);

}  // namespace tera
