#pragma once

#include <cstdint>
#include <vector>

#include "core/types/measurement.h"
#include "dataset/format/sensor_sheet.h"

namespace tera {

/// Rectifies images of a distorting lens to a pinhole camera with the same camera matrix.
///
/// Frames  Both images have the same pixel grid; (0, 0) is the centre of the upper left pixel.
/// Model   A pinhole pixel has the ray (x, y, 1). The lens maps this ray to x d + 2 p1 x y + p2
///         (r^2 + 2 x^2), y d + p1 (r^2 + 2 y^2) + 2 p2 x y, with d = (1 + k1 r^2 + k2 r^4 + k3
///         r^6) / (1 + k4 r^2 + k5 r^4 + k6 r^6). Pixels beyond the lens image are 0. Depth along
///         the optical axis does not change.
/// Omits   fisheye models (`kannala_brandt`, `f_theta`), whose field of view exceeds that of a
///         pinhole.
/// Source  Brown 1971; OpenCV's "Camera calibration and 3D reconstruction".
class Rectifier {
 public:
  /// True if the lens model can be rectified.
  static bool Takes(const CameraLens& lens);

  explicit Rectifier(const CameraLens& lens);

  /// False for a lens without distortion.
  bool changes_pictures() const { return !source_px_.empty(); }
  /// Bilinear interpolation, for colour. The image must have the size of the lens.
  Image<std::uint8_t> Blended(const Image<std::uint8_t>& picture) const;
  /// Nearest pixel, for depth and labels.
  Image<std::uint16_t> Nearest(const Image<std::uint16_t>& picture) const;

 private:
  int width_px_ = 0, height_px_ = 0;
  std::vector<float> source_px_;  ///< source coordinates x, y of each pixel; empty for a pinhole
};

}  // namespace tera
