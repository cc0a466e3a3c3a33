#pragma once

#include <array>

#include "core/types/terrain_surface.h"

namespace tera {

/// The look of a clod, the same for pictures and rays: an uneven icosahedron about the unit ball.
struct GrainShape {
  std::array<Eigen::Vector3f, 12> corners;
  std::array<std::array<std::uint8_t, 3>, 20> faces;  ///< seen from outside anticlockwise
};
const GrainShape& UnitGrain();

/// From the unit grain to W: turned as its number says, as large as its volume.
Eigen::Affine3f GrainToWorld(const TerrainSurface::Grain& grain);

}  // namespace tera
