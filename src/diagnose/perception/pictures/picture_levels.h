#pragma once

#include <array>

#include "core/motion.h"
#include "core/types/measurement.h"

namespace tera {

/// A picture with normalised exposure, at several levels of blur.
///
/// Model   (I - m) / sqrt(v + c^2). m and v are mean and variance of a window about each pixel, a
///         twentieth of the picture's width; c = 0.05. Gain, offset and vignetting cancel, and
///         noise in uniform areas stays small. Level k is this, blurred by 2^k pixels.
class PictureLevels {
 public:
  static constexpr int kCount = 4;
  static constexpr int kSmallest_px = 32;  ///< either side: four of the widest blur's
  /// `grey` is not smaller either way.
  explicit PictureLevels(const Image<float>& grey);

  /// Brightness at a point, interpolated between pixels; beyond the border as at the border.
  float At(int level, const Vec2& px) const;
  /// Gradient of the interpolated picture, by central differences over a pixel.
  Vec2 GradientAt(int level, const Vec2& px) const;
  /// Whether At and GradientAt use true pixels there, and not the repeated border.
  bool Holds(const Vec2& px) const;

 private:
  std::array<Image<float>, kCount> levels_;
};

/// Blurred by an approximate normal distribution of `sigma_px`: three moving averages, with the
/// border repeated.
Image<float> Blurred(const Image<float>& picture, double sigma_px);

}  // namespace tera
