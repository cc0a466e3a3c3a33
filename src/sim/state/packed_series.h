#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dataset/files/block_file.h"

namespace tera {

/// Numbers that vary smoothly from row to row, packed without loss for a compressor behind.
///
/// Model   a number's bits, ordered as an integer as the numbers are, are predicted by the
///         polynomial of degree 0, 1 or 2 through those of the rows before; of each column the
///         degree that leaves least. What is left is split into bytes, and bytes of one weight are
///         a stream: the high ones are nearly all zero.
/// Source  predictive coding of floating point, after Lindstrom and Isenburg 2006 (fpzip), without
///         their range coder.
class PackedSeries {
 public:
  explicit PackedSeries(std::size_t columns);

  /// Adds the streams of these rows, which follow those of the call before. `rows` is row-major.
  void Pack(std::span<const double> rows, Block* block);
  /// The rows from the streams of `block` from `*stream` on, which is moved behind them. Nothing
  /// where the streams are not those of `rows` rows.
  bool Unpack(const Block& block, std::size_t rows, std::size_t* stream, std::vector<double>* out);

  static constexpr std::size_t kStreams = 1 + sizeof(double);  ///< degrees, then bytes by weight

 private:
  static constexpr int kHistory = 3;
  struct Past {
    std::int64_t last[kHistory] = {};  ///< the newest first
  };
  std::vector<Past> past_;
};

// The bits of a number as an integer that orders as numbers do.
std::int64_t OrderedBits(double value);
double FromOrderedBits(std::int64_t bits);
std::int32_t OrderedBits(float value);
float FromOrderedBits(std::int32_t bits);

/// Small magnitudes of either sign as small numbers: 0, -1, 1, -2 as 0, 1, 2, 3.
constexpr std::uint64_t ZigZag(std::int64_t n) {
  return (static_cast<std::uint64_t>(n) << 1) ^ static_cast<std::uint64_t>(n >> 63);
}
constexpr std::int64_t FromZigZag(std::uint64_t n) {
  return static_cast<std::int64_t>(n >> 1) ^ -static_cast<std::int64_t>(n & 1);
}

/// What the polynomial of `degree` 0 to 2 through the last values says of the next one. Wraps
/// around, as the difference to it does.
std::int64_t Extrapolate(const std::int64_t* newest_first, int degree);

}  // namespace tera
