#pragma once

#include <memory>
#include <vector>

#include "core/types/ground_tools.h"
#include "render/scene.h"
#include "soil/soil.h"

namespace tera {

/// Visible surface of the soil in a shovel.
///
/// Frames  B frame of the shovel's link.
/// Model   The surface of HeapSurface at the angle of repose of the most abundant soil, roughened
///         downwards by clods. Clods are larger for cohesive soil than for sand. The colour of each
///         point mixes a quarter of one carried soil, drawn by volume shares, with three quarters
///         of the mean of all. A skirt hangs from the surface's border into the shell.
/// Omits   layers of soils: a shovel knows the amount of each soil, not its place. Clods keep their
///         places in the shovel while soil slides under them.
class CarriedSoil {
 public:
  /// `soils` are those of the site.
  CarriedSoil(const Shovel& shovel, const std::vector<SoilType>& soils);

  /// The mesh of the load in the shovel at X_WB; null without a load.
  std::shared_ptr<const ShapedMesh> Shape(const SoilReaction::Load& load, const Pose& X_WB) const;

 private:
  Shovel shovel_;
  std::vector<SoilType> soils_;
};

/// Share of each soil in a load's volume. If the masses are unknown, the first has all of it.
std::vector<double> VolumeShares(const SoilReaction::Load& load,
                                 const std::vector<SoilType>& soils);

/// Colour of loose soil, linear RGB.
Vec3 LooseAlbedo(const SoilType& soil);

}  // namespace tera
