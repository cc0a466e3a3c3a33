#pragma once

namespace tera {

/// Diffuse reflectance of a rough surface under a thin water film, from its dry reflectance, 0 to
/// 1.
///
/// Model   (1 - R) (1 - p) r / (1 - p r). Light that enters the film (1 - R) reflects diffusely
///         several times. Total and partial internal reflection retain the fraction p each time: p
///         = 1 - (1 - D) / n^2. D is the water's reflectance of diffuse light from outside.
///         n = 1.33, R = 0.02, D = 0.066.
/// Omits   higher absorption of a surface in water, which darkens it by some percent of r; specular
///         reflection by the water.
/// Source  Lekner and Dorf 1988, "Why some things are darker when wet", Applied Optics 27.
double WetReflectance(double dry);

}  // namespace tera
