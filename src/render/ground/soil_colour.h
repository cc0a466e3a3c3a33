#pragma once

namespace tera {

/// Brightness of soil relative to its dry bank, from its degree of saturation and how loose it is,
/// both in [0, 1].
///
/// Model   albedo falls exponentially with saturation to a share of the dry one (the shape that
///         Lobell and Asner 2002, Soil Sci. Soc. Am. J. 66, fit to measured reflectance); loose
///         soil is a little lighter.
double SoilTone(double saturation, double looseness);

}  // namespace tera
