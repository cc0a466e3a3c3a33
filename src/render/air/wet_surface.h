#pragma once

namespace tera {

/// Diffuse reflectance of a rough surface under a thin film of water, by its dry one, 0 to 1.
///
/// Model   (1 - R) (1 - p) r / (1 - p r): light that enters the film (1 - R) is reflected diffusely
///         again and again, each time with a share p held back under the water by total and partial
///         reflection; p = 1 - (1 - D) / n^2, with D the water's reflectance of diffuse light from
///         outside. n = 1.33, R = 0.02, D = 0.066.
/// Omits   that a surface in water absorbs more than in air, which darkens it further by some per
///         cent of r; light mirrored by the water itself.
/// Source  Lekner and Dorf 1988, "Why some things are darker when wet", Applied Optics 27.
double WetReflectance(double dry);

}  // namespace tera
