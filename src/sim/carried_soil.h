#pragma once

#include <memory>
#include <vector>

#include "core/types/ground_tools.h"
#include "render/scene.h"
#include "soil/soil.h"

namespace tera {

/// How the soil in a shovel looks.
///
/// Frames  B frame of the shovel's link.
/// Model   The surface of HeapSurface at the angle of repose of the soil of which most is carried,
///         roughened by clods below it: of cohesive soil larger ones than of sand. The colour of
///         each point is for a quarter that of one of the soils carried, drawn by their shares of
///         the volume, and else the mean of all. A skirt hangs from its border into the shell.
/// Omits   layers, in which soils came in: a shovel knows how much of each it carries, not where.
///         Clods keep their places in the shovel while soil slides under them.
class CarriedSoil {
 public:
  /// `soils` are those of the site.
  CarriedSoil(const Shovel& shovel, const std::vector<SoilType>& soils);

  /// The load as it lies in the shovel at X_WB; null where there is none.
  std::shared_ptr<const ShapedMesh> Shape(const SoilReaction::Load& load, const Pose& X_WB) const;

 private:
  Shovel shovel_;
  std::vector<SoilType> soils_;
};

/// Share of each soil in a load's volume, or all of the first where masses are not known.
std::vector<double> VolumeShares(const SoilReaction::Load& load,
                                 const std::vector<SoilType>& soils);

/// Colour of a soil as it lies in a shovel, linear RGB.
Vec3 LooseAlbedo(const SoilType& soil);

}  // namespace tera
