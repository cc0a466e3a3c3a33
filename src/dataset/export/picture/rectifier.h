#pragma once

#include <cstdint>
#include <vector>

#include "core/types/measurement.h"
#include "dataset/format/sensor_sheet.h"

namespace tera {

/// Rectifies pictures of a distorting lens to a pinhole with the same camera matrix.
///
/// Frames  pixels of one grid in both pictures; (0, 0) is the centre of the upper left pixel.
/// Model   a pixel of the pinhole looks along (x, y, 1); the lens maps this direction to x d + 2 p1
///         x y + p2 (r^2 + 2 x^2), y d + p1 (r^2 + 2 y^2) + 2 p2 x y, with d = (1 + k1 r^2 + k2 r^4
///         + k3 r^6) / (1 + k4 r^2 + k5 r^4 + k6 r^6). Pixels outside the lens's picture are 0.
///         Depth along the axis is unchanged.
/// Omits   lenses that map the angle from the axis: their field exceeds a pinhole's.
/// Source  Brown 1971; OpenCV's "Camera calibration and 3D reconstruction".
class Rectifier {
 public:
  /// Whether the lens can be rectified.
  static bool Takes(const CameraLens& lens);

  explicit Rectifier(const CameraLens& lens);

  /// False for a pinhole.
  bool changes_pictures() const { return !source_px_.empty(); }
  /// Bilinear, for colour. Pictures must have the lens's size.
  Image<std::uint8_t> Blended(const Image<std::uint8_t>& picture) const;
  /// Nearest pixel, for depth and labels.
  Image<std::uint16_t> Nearest(const Image<std::uint16_t>& picture) const;

 private:
  int width_px_ = 0, height_px_ = 0;
  std::vector<float> source_px_;  ///< x, y of each pixel; empty for a pinhole
};

}  // namespace tera
