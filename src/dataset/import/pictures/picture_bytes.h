#pragma once

#include <string>
#include <string_view>

#include "core/types/measurement.h"

namespace tera {

/// A decoded image: colour, or depth in metres. Depth 0 means no measurement.
struct ImportedPicture {
  Image<std::uint8_t> rgb;
  Image<float> depth_m;

  int width_px() const { return rgb.empty() ? depth_m.width_px : rgb.width_px; }
  int height_px() const { return rgb.empty() ? depth_m.height_px : rgb.height_px; }
};

/// Raw pixels of a sensor_msgs/Image.
struct RawPixels {
  int width_px = 0, height_px = 0;
  std::string_view encoding;
  bool is_big_endian = false;
  std::size_t step_bytes = 0;  ///< bytes from one row to the next
  std::string_view bytes;
};

/// Decodes raw pixels.
///
/// Model   Colour encodings: rgb8, bgr8, rgba8, bgra8, mono8, 8UC1, 8UC3 and 8UC4 (as bgr),
///         bayer_*8 (bilinear), uyvy and yuv422, yuyv and yuv422_yuy2. Depth encodings: 16UC1 in
///         mm, 32FC1 in m.
/// Throws  InputError with `place` for any other encoding, and if the number of bytes does not fit
///         the size.
ImportedPicture DecodePixels(const RawPixels& pixels, const std::string& place);

/// Decodes a PNG or JPEG file: 8-bit colour, 8-bit grey, or 16-bit grey as depth in mm. Throws
/// InputError with `place` for any other format and for a truncated file.
ImportedPicture DecodePictureFile(std::string_view bytes, const std::string& place);

}  // namespace tera
