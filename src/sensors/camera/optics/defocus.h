#pragma once

#include <vector>

#include "core/types/measurement.h"

namespace tera {

/// A thin lens that is focused on one distance.
///
/// Model   `image_m` from the lens to the picture; a point at the distance z makes a disc on the
///         picture of the diameter A image |1 / z - 1 / focus|, A the pupil's.
/// Source  Potmesil and Chakravarty 1981, "A lens and aperture camera model for synthetic image
///         generation", eqs. (1) to (4).
struct ThinLens {
  double pupil_m = 0, image_m = 0, pixel_m = 0, focus_m = 0;

  /// Radius of the disc in pixels; depth 0 is infinitely far. At most kMostRadius_px.
  double Radius_px(double depth_m) const;

  static constexpr double kMostRadius_px = 32;
};

/// Discs of light, spread evenly over the pixels' areas.
///
/// Model   for each of a row of radii in steps of 1 / kStepsPerPixel the share of the disc's light
///         that falls on each pixel about its middle, by kParts^2 points of each pixel; the disc is
///         smaller by as much as pixels are wide themselves.
class DiscKernels {
 public:
  static constexpr int kStepsPerPixel = 8, kParts = 16;

  explicit DiscKernels(double most_radius_px);

  /// The kernel's number for a radius.
  static int NumberOf(double radius_px);
  /// Pixels that it reaches beyond its middle.
  static int ReachOf(int number);
  /// The share of the light on the pixel at that offset, within its reach.
  float Share(int number, int dx_px, int dy_px) const;

 private:
  std::vector<std::vector<float>> quarters_;  ///< of dx and dy from 0 to its reach
};

/// A picture as the lens blurs it, pixel by pixel by the depth of what it shows.
///
/// Model   each pixel's light is spread over its disc. Of what a pixel gathers, light of nearer
///         things covers that of its own surface, as far as their discs' shares go, and that covers
///         what lies behind, of which the mean within the own disc stands for what is hidden there.
///         Things are apart where their depths differ by a hundredth.
/// Omits   diffraction; discs other than round; light beyond kMostRadius_px.
Image<float> Defocused(const ThinLens& lens, const DiscKernels& kernels,
                       const Image<float>& depth_m, const Image<float>& luminance_cdpm2);

}  // namespace tera
