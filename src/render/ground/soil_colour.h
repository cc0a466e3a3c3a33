#pragma once

namespace tera {

/// Brightness of soil relative to dry undisturbed soil. Saturation and looseness are in [0, 1].
///
/// Model   albedo falls exponentially with saturation, to a fraction of the dry albedo. Loose soil
///         is slightly lighter.
/// Source  Lobell and Asner 2002, Soil Sci. Soc. Am. J. 66: exponential fit to measured
///         reflectance.
double SoilTone(double saturation, double looseness);

}  // namespace tera
