#include "dataset/format/png_rows.h"

#include <libdeflate.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <string>
#include <utility>

namespace tera {
namespace {

constexpr std::string_view kSignature("\x89PNG\r\n\x1a\n", 8);
constexpr std::size_t kAroundChunk = 12;  ///< length, name and checksum of a chunk
constexpr std::size_t kHeaderBytes = 13;
/// RFC 1951: the largest expansion of a compressed stream.
constexpr std::size_t kMostExpansion = 1032;

/// Header of a PNG and its compressed pixels.
struct Packed {
  std::string_view header;
  std::string pixels;
};

/// Returns nullopt if a chunk is truncated, damaged, or of a kind that changes how pixels are
/// decoded.
std::optional<Packed> Unpacked(std::string_view png) {
  if (!png.starts_with(kSignature)) return std::nullopt;
  Packed packed;
  packed.pixels.reserve(png.size());
  for (std::size_t at = kSignature.size(); png.size() - at >= kAroundChunk;) {
    const std::size_t length = PngNumberAt(png, at);
    if (length > png.size() - at - kAroundChunk) return std::nullopt;
    const std::string_view summed = png.substr(at + 4, 4 + length);
    const std::string_view name = summed.substr(0, 4), content = summed.substr(4);
    at += kAroundChunk + length;
    if (PngNumberAt(png, at - 4) != libdeflate_crc32(0, summed.data(), summed.size())) {
      return std::nullopt;
    }
    const bool is_header = name == "IHDR";
    if (is_header != packed.header.empty())
      return std::nullopt;  // exactly one header, at the beginning
    if (is_header) {
      if (length != kHeaderBytes) return std::nullopt;
      packed.header = content;
    }
    if (name == "IDAT") packed.pixels += content;
    if (name == "PLTE" || name == "tRNS") return std::nullopt;
    if (name == "IEND") return at == png.size() ? std::optional(std::move(packed)) : std::nullopt;
  }
  return std::nullopt;
}

/// Reads size and pixel format from the header; nullopt for an unsupported format.
std::optional<PngRows> FormOf(std::string_view header) {
  constexpr char kGrey = 0, kRgb = 2;
  constexpr std::uint32_t kMostPixels = 1 << 20;  // per side, OpenCV's limit
  const std::uint32_t width = PngNumberAt(header, 0), height = PngNumberAt(header, 4);
  const char bits = header[8], colour = header[9];
  const bool is_plain = header.substr(10) == std::string_view("\0\0\0", 3);
  if (width == 0 || height == 0 || width > kMostPixels || height > kMostPixels || !is_plain ||
      (bits != 8 && bits != 16) || (colour != kGrey && colour != kRgb)) {
    return std::nullopt;
  }
  return PngRows{
      static_cast<int>(width), static_cast<int>(height), colour == kRgb ? 3 : 1, bits, {}};
}

/// Undoes the filter of a row. The filter has subtracted a prediction from each byte. The
/// prediction uses the pixels to the left, above, and above left. `pixel` is the size of a pixel in
/// bytes. The row above the first row is 0.
template <std::size_t pixel>
bool Unfilter(std::uint8_t filter, const std::uint8_t* above, std::size_t count,
              std::uint8_t* row) {
  const auto each = [&](auto guess) {
    std::uint8_t before[pixel] = {}, above_before[pixel] = {};
    for (std::size_t k = 0; k < count; k += pixel) {
      for (std::size_t c = 0; c < pixel; ++c) {
        const std::uint8_t up = above[k + c];
        row[k + c] = before[c] =
            static_cast<std::uint8_t>(row[k + c] + guess(before[c], up, above_before[c]));
        above_before[c] = up;
      }
    }
    return true;
  };
  switch (filter) {
    case 0:
      return true;
    case 1:
      return each([](int left, int, int) { return left; });
    case 2:
      for (std::size_t k = 0; k < count; ++k) row[k] = static_cast<std::uint8_t>(row[k] + above[k]);
      return true;
    case 3:
      return each([](int left, int up, int) { return (left + up) / 2; });
    case 4:
      return each([](int left, int up, int corner) {
        const int by_left = std::abs(up - corner), by_up = std::abs(left - corner),
                  by_corner = std::abs(left + up - 2 * corner);
        return by_left <= by_up && by_left <= by_corner ? left : by_up <= by_corner ? up : corner;
      });
    default:
      return false;
  }
}

/// Undoes the filters of all rows; returns false for an unknown filter.
bool UnfilterAll(std::vector<std::uint8_t>* filtered, std::size_t count, std::size_t pixel,
                 PngRows* rows) {
  const std::vector<std::uint8_t> zeros(count, 0);
  const std::uint8_t* above = zeros.data();
  rows->bytes.resize(count * static_cast<std::size_t>(rows->height_px));
  for (int y = 0; y < rows->height_px; ++y) {
    std::uint8_t* const row = filtered->data() + static_cast<std::size_t>(y) * (count + 1);
    const bool is_done = pixel == 1   ? Unfilter<1>(row[0], above, count, row + 1)
                         : pixel == 2 ? Unfilter<2>(row[0], above, count, row + 1)
                         : pixel == 3 ? Unfilter<3>(row[0], above, count, row + 1)
                                      : Unfilter<6>(row[0], above, count, row + 1);
    if (!is_done) return false;
    above = row + 1;
    std::copy_n(above, count, rows->bytes.data() + static_cast<std::size_t>(y) * count);
  }
  return true;
}

struct FreeDecompressor {
  void operator()(libdeflate_decompressor* d) const { libdeflate_free_decompressor(d); }
};

}  // namespace

std::optional<PngRows> DecodePngRows(std::string_view png) {
  const std::optional<Packed> packed = Unpacked(png);
  if (!packed) return std::nullopt;
  std::optional<PngRows> rows = FormOf(packed->header);
  if (!rows) return std::nullopt;
  const auto pixel = static_cast<std::size_t>(rows->components * rows->component_bits / 8);
  const std::size_t count = pixel * static_cast<std::size_t>(rows->width_px);
  const std::size_t all = (count + 1) * static_cast<std::size_t>(rows->height_px);
  if (all / kMostExpansion > packed->pixels.size()) return std::nullopt;
  std::vector<std::uint8_t> filtered(all);
  const std::unique_ptr<libdeflate_decompressor, FreeDecompressor> decompressor(
      libdeflate_alloc_decompressor());
  const bool is_whole =
      decompressor &&
      libdeflate_zlib_decompress(decompressor.get(), packed->pixels.data(), packed->pixels.size(),
                                 filtered.data(), all, nullptr) == LIBDEFLATE_SUCCESS;
  if (!is_whole || !UnfilterAll(&filtered, count, pixel, &*rows)) return std::nullopt;
  return rows;
}

std::uint32_t PngNumberAt(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t k = at; k < at + 4; ++k) {
    value = value << 8 | static_cast<unsigned char>(bytes[k]);
  }
  return value;
}

}  // namespace tera
