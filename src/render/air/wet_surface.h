#pragma once

namespace tera {

/// Diffuse reflectance in [0, 1] of a rough surface under a thin water film, given its dry
/// reflectance r.
///
/// Model   (1 - R) (1 - p) r / (1 - p r). R = 0.02 is the reflectance of the film at normal
///         incidence. p is the share of the light from below that the film's surface reflects back
///         down: p = 1 - (1 - D) / n^2. D = 0.066 is the water's reflectance of diffuse light from
///         outside, n = 1.33. The denominator sums the repeated reflections between film and
///         surface.
/// Omits   higher absorption of a surface in water, which darkens it by some percent of r; specular
///         reflection by the water.
/// Source  Lekner and Dorf 1988, "Why some things are darker when wet", Applied Optics 27.
double WetReflectance(double dry);

}  // namespace tera
