#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace tera {

/// Pixels of a PNG, row by row, in the byte order of the file: a 16-bit sample has its high byte
/// first.
struct PngRows {
  int width_px = 0, height_px = 0;
  int components = 0;      ///< 1: grey; 3: red, green, blue
  int component_bits = 0;  ///< 8 or 16
  std::vector<std::uint8_t> bytes;
};

/// Decodes a PNG of the kinds that recordings contain, several times as fast as libpng with zlib.
///
/// Model   Returns nullopt for a wrong checksum and for any other kind of PNG: with palette, alpha
///         channel, interlacing, or fewer than 8 bits.
/// Source  ISO/IEC 15948:2004, "Portable Network Graphics", 5 to 9; RFC 1950 by libdeflate.
std::optional<PngRows> DecodePngRows(std::string_view png);

/// The 32-bit number at byte `at`, high byte first.
std::uint32_t PngNumberAt(std::string_view png, std::size_t at);

}  // namespace tera
