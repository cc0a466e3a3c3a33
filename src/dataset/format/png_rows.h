#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace tera {

/// The pixels of a PNG, row by row, in the file's byte order: 16-bit numbers have the high byte
/// first.
struct PngRows {
  int width_px = 0, height_px = 0;
  int components = 0;      ///< 1 grey, 3 red, green, blue
  int component_bits = 0;  ///< 8 or 16
  std::vector<std::uint8_t> bytes;
};

/// Decodes a PNG in the form of recordings, several times as fast as libpng with zlib.
///
/// Model   returns nothing for a file with invalid checksums, or of another form: with a palette,
///         an alpha channel, interlacing, or fewer than 8 bits.
/// Source  ISO/IEC 15948:2004, "Portable Network Graphics", 5 to 9; RFC 1950 by libdeflate.
std::optional<PngRows> DecodePngRows(std::string_view png);

/// A number of a PNG, high byte first.
std::uint32_t PngNumberAt(std::string_view png, std::size_t at);

}  // namespace tera
