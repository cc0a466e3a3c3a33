#pragma once

#include <memory>
#include <vector>

#include "core/types/ground_tools.h"
#include "render/scene.h"
#include "soil/soil.h"

namespace tera {

/// Visible surface of the soil in a shovel.
///
/// Frames  B is the frame of the shovel's link.
/// Model   the surface of HeapSurface, with the angle of repose of the soil that has the largest
///         mass. Clods roughen it: their noise lowers the surface between them. Cohesive soil has
///         larger clods than sand. The colour of a point is one quarter the colour of a single
///         carried soil (drawn by volume shares) and three quarters the mean colour of all carried
///         soils. A skirt closes the gap between the surface's border and the shell.
/// Omits   layers of soils: only the amount of each soil in a shovel is known. Clods keep their
///         places in the shovel while soil slides under them.
class CarriedSoil {
 public:
  /// `soils` are the soils of the site.
  CarriedSoil(const Shovel& shovel, const std::vector<SoilType>& soils);

  /// Mesh of the load, for the shovel's link at X_WB. Null without a load.
  std::shared_ptr<const ShapedMesh> Shape(const SoilReaction::Load& load, const Pose& X_WB) const;

 private:
  Shovel shovel_;
  std::vector<SoilType> soils_;
};

/// Volume share of each soil in a load. If the masses are unknown, the first soil counts as the
/// whole load.
std::vector<double> VolumeShares(const SoilReaction::Load& load,
                                 const std::vector<SoilType>& soils);

/// Colour of loose soil in linear RGB, at the soil's moisture.
Vec3 LooseAlbedo(const SoilType& soil);

}  // namespace tera
