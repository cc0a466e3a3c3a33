#pragma once

#include "core/types/terrain_surface.h"
#include "render/air/weather.h"

/// What weather makes of the ground's looks, alike for pictures and lidars.

namespace tera {

/// Share of the ground that lies under snow, 0 to 1.
///
/// Model   tanh(d / 2.5 z) of snow of depth d on ground of roughness z = 1 cm; none on slopes
///         beyond 50 degrees, all below 35; none on ground that is loose or rutted: it has been
///         worked since snow fell.
/// Source  Yang et al. 1997, "Validation of the snow submodel of BATS", J. Climate 10, eq. 4; angle
///         at which dry snow slides off: about 50 degrees (McClung and Schaerer, The Avalanche
///         Handbook, 2006).
double SnowShare(const Weather& weather, const TerrainSurface::Cover& cover, double normal_z);

/// Degree of saturation of the surface: rain fills it.
double SurfaceSaturation(const Weather& weather, double saturation);

/// Albedo of fresh snow by colour, and its reflectance at 905 nm.
/// Source: Warren 1982, "Optical properties of snow", Rev. Geophys. 20, figures 1 and 11.
inline const Vec3 kSnowAlbedo(0.86, 0.88, 0.90);
inline constexpr double kSnowReflectance = 0.80;

}  // namespace tera
