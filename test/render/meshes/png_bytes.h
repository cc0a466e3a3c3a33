#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

/// PNG files of known colours, for tests that may not include a library that writes them.
///
/// Source  RFC 2083 (PNG), RFC 1950 (Adler-32), RFC 1951 (stored blocks).

namespace tera::testing_mesh {

using Rgb = std::array<std::uint8_t, 3>;

inline std::string BigEndian(std::uint32_t n) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(n >> shift);
  return bytes;
}

inline std::string Chunk(const std::string& type, const std::string& data) {
  std::uint32_t crc = 0xffffffff;
  for (const char c : type + data) {
    crc ^= static_cast<std::uint8_t>(c);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1) != 0 ? 0xedb88320 : 0);
  }
  return BigEndian(static_cast<std::uint32_t>(data.size())) + type + data + BigEndian(~crc);
}

/// Rows from the top, not compressed.
inline std::string PngBytes(const std::vector<std::vector<Rgb>>& rows) {
  std::string raw;
  for (const std::vector<Rgb>& row : rows) {
    raw += '\0';  // no filter
    for (const Rgb& pixel : row) raw.append(reinterpret_cast<const char*>(pixel.data()), 3);
  }
  std::uint32_t a = 1, b = 0;
  for (const char c : raw) {
    a = (a + static_cast<std::uint8_t>(c)) % 65521;
    b = (b + a) % 65521;
  }
  const auto low = [](std::size_t n) { return static_cast<char>(n & 0xff); };
  const auto high = [](std::size_t n) { return static_cast<char>((n >> 8) & 0xff); };
  std::string zlib = "\x78\x01\x01";
  zlib += low(raw.size()), zlib += high(raw.size());
  zlib += low(~raw.size()), zlib += high(~raw.size());
  zlib += raw + BigEndian((b << 16) | a);
  std::string header = BigEndian(static_cast<std::uint32_t>(rows.front().size())) +
                       BigEndian(static_cast<std::uint32_t>(rows.size()));
  header += std::string("\x08\x02\x00\x00\x00", 5);  // 8 bits, RGB
  return "\x89PNG\r\n\x1a\n" + Chunk("IHDR", header) + Chunk("IDAT", zlib) + Chunk("IEND", "");
}

}  // namespace tera::testing_mesh
