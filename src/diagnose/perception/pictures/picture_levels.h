#pragma once

#include <array>

#include "core/motion.h"
#include "core/types/measurement.h"

namespace tera {

/// A picture without its exposure, in several degrees of blur.
///
/// Model   (I - m) / sqrt(v + c^2) with the mean m and the variance v of a window of a twentieth of
///         the picture's width about each pixel and c = 0.05: gain, offset and vignetting fall out,
///         and what is as flat as noise stays small. Level k is that, blurred by 2^k pixels.
class PictureLevels {
 public:
  static constexpr int kCount = 4;
  static constexpr int kSmallest_px = 32;  ///< either side: four of the widest blur's
  /// `grey` is not smaller either way.
  explicit PictureLevels(const Image<float>& grey);

  /// Brightness at a place, interpolated between pixels; beyond the border as at the border.
  float At(int level, const Vec2& px) const;
  /// Gradient of the interpolated picture, by central differences over a pixel.
  Vec2 GradientAt(int level, const Vec2& px) const;
  /// Whether At and GradientAt are of what the picture shows there, not of its border repeated.
  bool Holds(const Vec2& px) const;

 private:
  std::array<Image<float>, kCount> levels_;
};

/// Blurred by about a normal distribution of `sigma_px`: three means of a sliding window, the
/// border repeated.
Image<float> Blurred(const Image<float>& picture, double sigma_px);

}  // namespace tera
