#pragma once

#include "core/types/terrain_surface.h"
#include "render/air/weather.h"

/// Effects of weather on the ground's appearance, common to images and lidars.

namespace tera {

/// Fraction of the ground that snow covers, in [0, 1].
///
/// Model   tanh(d / 2.5 z), for snow of depth d on ground of roughness z = 1 cm. Between slopes of
///         35 and 50 degrees the fraction falls to 0. Loose or rutted ground has no snow, since
///         work has disturbed it.
/// Source  Yang et al. 1997, "Validation of the snow submodel of BATS", J. Climate 10, eq. 4; angle
///         at which dry snow slides off: about 50 degrees (McClung and Schaerer, The Avalanche
///         Handbook, 2006).
double SnowShare(const Weather& weather, const TerrainSurface::Cover& cover, double normal_z);

/// Albedo of fresh snow by colour channel, and its reflectance at 905 nm.
///
/// Source  Warren 1982, "Optical properties of snow", Rev. Geophys. 20, figures 1 and 11.
inline const Vec3 kSnowAlbedo(0.86, 0.88, 0.90);
inline constexpr double kSnowReflectance = 0.80;

}  // namespace tera
