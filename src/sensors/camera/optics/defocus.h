#pragma once

#include <vector>

#include "core/types/measurement.h"

namespace tera {

/// A thin lens focused at one distance.
///
/// Model   `image_m` is the distance from lens to sensor. A point at distance z forms a disc of
///         diameter A image |1 / z - 1 / focus| on the sensor, A the pupil's diameter.
/// Source  Potmesil and Chakravarty 1981, "A lens and aperture camera model for synthetic image
///         generation", eqs. (1) to (4).
struct ThinLens {
  double pupil_m = 0, image_m = 0, pixel_m = 0, focus_m = 0;

  /// Radius of the disc in pixels, at most kMostRadius_px; depth 0 is infinitely far.
  double Radius_px(double depth_m) const;

  static constexpr double kMostRadius_px = 32;
};

/// Blur kernels: uniform discs integrated over pixel areas.
///
/// Model   for radii in steps of 1 / kStepsPerPixel, the fraction of the disc's light on each pixel
///         around its centre, from kParts^2 points per pixel. The disc shrinks to compensate for
///         the pixels' own width.
class DiscKernels {
 public:
  static constexpr int kStepsPerPixel = 8, kParts = 16;

  explicit DiscKernels(double most_radius_px);

  /// Kernel number of a radius.
  static int NumberOf(double radius_px);
  /// Kernel reach in pixels from its centre.
  static int ReachOf(int number);
  /// Fraction of the light on the pixel at that offset, within the reach.
  float Share(int number, int dx_px, int dy_px) const;

 private:
  std::vector<std::vector<float>> quarters_;  ///< quadrant of dx and dy from 0 to the reach
};

/// Applies defocus pixel by pixel, according to the depth.
///
/// Model   each pixel's light is spread over its disc. A pixel gathers three layers. The light of
///         nearer surfaces covers its own surface's light, by the sum of their kernel shares. Its
///         own surface's light covers the background. The mean of the background within its own
///         disc represents the occluded background; without any, its own surface does. Surfaces are
///         separate if their depths differ by a hundredth.
/// Omits   diffraction; non-circular discs; light beyond kMostRadius_px.
Image<float> Defocused(const ThinLens& lens, const DiscKernels& kernels,
                       const Image<float>& depth_m, const Image<float>& luminance_cdpm2);

}  // namespace tera
