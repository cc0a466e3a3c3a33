#pragma once

#include <string>
#include <string_view>

#include "core/types/measurement.h"

namespace tera {

/// Pixels as they are imported: colour, or depth in metres with 0 where nothing was measured.
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
  std::size_t step_bytes = 0;  ///< from row to row
  std::string_view bytes;
};

/// Decodes raw pixels.
///
/// Model   colour: rgb8, bgr8, rgba8, bgra8, mono8, 8UC1, 8UC3 and 8UC4 (as bgr), bayer_*8
///         (bilinear), uyvy and yuv422, yuyv and yuv422_yuy2. Depth: 16UC1 in mm, 32FC1 in m.
/// Throws  InputError with `place` for another encoding, and for bytes that do not fit the size.
ImportedPicture DecodePixels(const RawPixels& pixels, const std::string& place);

/// Decodes the bytes of a PNG or JPEG file: colour of 8 bits, grey of 8 bits, or depth in mm as
/// grey of 16 bits. Throws InputError with `place` for another format, and for a file cut off.
ImportedPicture DecodePictureFile(std::string_view bytes, const std::string& place);

}  // namespace tera
