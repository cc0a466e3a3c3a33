#pragma once

#include <array>

#include "core/types/terrain_surface.h"

namespace tera {

/// Shape of a clod, common to images and rays: an icosahedron with uneven radius, about the unit
/// sphere.
struct GrainShape {
  std::array<Eigen::Vector3f, 12> corners;
  std::array<std::array<std::uint8_t, 3>, 20> faces;  ///< counter-clockwise from outside
};
const GrainShape& UnitGrain();

/// Transform from the unit grain to W. The number of the grain sets its rotation, its volume sets
/// the scale.
Eigen::Affine3f GrainToWorld(const TerrainSurface::Grain& grain);

}  // namespace tera
