#pragma once

#include <vector>

#include "core/types/measurement.h"

namespace tera {

/// A thin lens focused at one distance.
///
/// Model   `image_m` is the distance from lens to sensor. A point at distance z forms a disc of
///         diameter A image |1 / z - 1 / focus| on the sensor, where A is the diameter of the
///         pupil.
/// Source  Potmesil and Chakravarty 1981, "A lens and aperture camera model for synthetic image
///         generation", eqs. (1) to (4).
struct ThinLens {
  double pupil_m = 0, image_m = 0, pixel_m = 0, focus_m = 0;

  /// Radius of the disc in pixels, at most kMostRadius_px. A depth of 0 is infinitely far.
  double Radius_px(double depth_m) const;

  static constexpr double kMostRadius_px = 32;
};

/// Blur kernels: uniform discs integrated over the areas of pixels.
///
/// Model   One kernel for each radius in steps of 1 / kStepsPerPixel. It holds the share of the
///         disc's light on each pixel around the centre, from kParts^2 points per pixel. The disc
///         is reduced to compensate for the width of a pixel.
class DiscKernels {
 public:
  static constexpr int kStepsPerPixel = 8, kParts = 16;

  explicit DiscKernels(double most_radius_px);

  /// Kernel number of a radius.
  static int NumberOf(double radius_px);
  /// Reach of a kernel in pixels from its centre.
  static int ReachOf(int number);
  /// Share of the light on the pixel at an offset from the centre.
  float Share(int number, int dx_px, int dy_px) const;

 private:
  std::vector<std::vector<float>> quarters_;  ///< quadrant of dx and dy from 0 to the reach
};

/// Blurs an image pixel by pixel, according to depth.
///
/// Model   The light of each pixel is spread over its disc. A pixel gathers three layers by their
///         kernel shares: light of nearer surfaces, of its own surface, and of the background. Each
///         layer covers the next. The background is the mean of farther surfaces within the pixel's
///         own disc, else the own surface. Surfaces are separate if their depths differ by 1 %.
/// Omits   Diffraction; non-circular discs; light beyond kMostRadius_px.
Image<float> Defocused(const ThinLens& lens, const DiscKernels& kernels,
                       const Image<float>& depth_m, const Image<float>& luminance_cdpm2);

}  // namespace tera
