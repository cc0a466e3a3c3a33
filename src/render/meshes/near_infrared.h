#pragma once

#include "core/motion.h"
#include "core/types/labels.h"
#include "render/meshes/mesh.h"

namespace tera {

/// Diffuse reflectance of green leaves at 905 nm.
///
/// Source  the plateau from 750 to 1300 nm of many species: Jacquemoud and Baret 1990, "PROSPECT: a
///         model of leaf optical properties spectra"; Slaton, Hunt and Smith 2001, "Estimating
///         near-infrared leaf reflectance from leaf structural characteristics".
inline constexpr double kLeafNearInfrared = 0.45;

/// Diffuse reflectance of bare soil at 905 nm from its linear colour.
///
/// Model   the soil line, near infrared = 1.2 red + 0.04, at most 1. Water moves a soil along it.
/// Source  Baret and Guyot 1991, "Potentials and limits of vegetation indices for LAI and APAR
///         assessment".
/// Omits   the spread between soils; asphalt and gravel are taken as soils.
double SoilNearInfrared(const Vec3& albedo);

/// Diffuse reflectance of a dry surface at 905 nm: as its material states, else that of leaves for
/// vegetation, the soil line for soil, and the mean of the colour for all others.
///
/// Omits   pigments that reflect otherwise in the near infrared, such as those of cloth.
double NearInfrared(const Material& material, SemanticClass label);

}  // namespace tera
