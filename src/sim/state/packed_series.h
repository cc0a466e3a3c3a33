#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dataset/files/block_file.h"

namespace tera {

/// Lossless packing of numbers that vary smoothly from row to row, for a general compressor.
///
/// Model   the bits of a number become an integer that has the order of the numbers. A polynomial
///         of degree 0, 1 or 2 through the previous rows predicts it. Each column uses the degree
///         with the smallest residual. Residuals are split into bytes; each byte position has its
///         own stream, so that the streams of the high bytes are nearly all zero.
/// Source  predictive coding of floating point, after Lindstrom and Isenburg 2006 (fpzip), without
///         their range coder.
class PackedSeries {
 public:
  explicit PackedSeries(std::size_t columns);

  /// Appends the streams of further rows to `block`. `rows` is row-major.
  void Pack(std::span<const double> rows, Block* block);
  /// Reads `rows` rows from the streams of `block`, starting at stream `*stream`. Advances
  /// `*stream` past them. Returns false if the streams do not contain that many rows.
  bool Unpack(const Block& block, std::size_t rows, std::size_t* stream, std::vector<double>* out);

  /// one for the degrees, and one per byte position
  static constexpr std::size_t kStreams = 1 + sizeof(double);

 private:
  static constexpr int kHistory = 3;
  struct Past {
    std::int64_t last[kHistory] = {};  ///< the newest first
  };
  std::vector<Past> past_;
};

// Bits of a number as an integer that sorts like the number.
std::int64_t OrderedBits(double value);
double FromOrderedBits(std::int64_t bits);
std::int32_t OrderedBits(float value);
float FromOrderedBits(std::int32_t bits);

/// Maps small integers of either sign to small unsigned ones: 0, -1, 1, -2 to 0, 1, 2, 3.
constexpr std::uint64_t ZigZag(std::int64_t n) {
  return (static_cast<std::uint64_t>(n) << 1) ^ static_cast<std::uint64_t>(n >> 63);
}
constexpr std::int64_t FromZigZag(std::uint64_t n) {
  return static_cast<std::int64_t>(n >> 1) ^ -static_cast<std::int64_t>(n & 1);
}

/// Extrapolates the last values by a polynomial of degree 0 to 2. Overflow wraps around, as it does
/// in the residual.
std::int64_t Extrapolate(const std::int64_t* newest_first, int degree);

}  // namespace tera
