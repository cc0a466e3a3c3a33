#include "sim/state/packed_series.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>

#include "core/check.h"

namespace tera {
namespace {

constexpr int kDegrees = 3;

/// Difference modulo 2^64, which cannot overflow.
std::int64_t Minus(std::int64_t a, std::int64_t b) {
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) - static_cast<std::uint64_t>(b));
}
std::int64_t Plus(std::int64_t a, std::int64_t b) {
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) + static_cast<std::uint64_t>(b));
}

// The bits of a number are sign and magnitude.
template <typename Int>
Int Ordered(Int bits) {
  return bits < 0 ? ~(bits & std::numeric_limits<Int>::max()) : bits;
}
template <typename Int>
Int Unordered(Int bits) {
  return bits < 0 ? ~bits | std::numeric_limits<Int>::min() : bits;
}

void Remember(std::int64_t value, std::int64_t* newest_first, int count) {
  std::copy_backward(newest_first, newest_first + count - 1, newest_first + count);
  newest_first[0] = value;
}

}  // namespace

std::int64_t OrderedBits(double value) { return Ordered(std::bit_cast<std::int64_t>(value)); }
double FromOrderedBits(std::int64_t bits) { return std::bit_cast<double>(Unordered(bits)); }
std::int32_t OrderedBits(float value) { return Ordered(std::bit_cast<std::int32_t>(value)); }
float FromOrderedBits(std::int32_t bits) { return std::bit_cast<float>(Unordered(bits)); }

std::int64_t Extrapolate(const std::int64_t* x, int degree) {
  if (degree == 0) return x[0];
  const std::int64_t slope = Minus(x[0], x[1]);
  if (degree == 1) return Plus(x[0], slope);
  return Plus(Plus(x[0], slope), Minus(slope, Minus(x[1], x[2])));
}

PackedSeries::PackedSeries(std::size_t columns) : past_(columns) {}

void PackedSeries::Pack(std::span<const double> rows, Block* block) {
  const std::size_t columns = past_.size(), count = columns == 0 ? 0 : rows.size() / columns;
  TERA_CHECK(count * columns == rows.size(), rows.size(), columns);
  std::string degrees(columns, '\0');
  std::array<std::string, sizeof(double)> planes;
  for (std::string& plane : planes) plane.reserve(rows.size());
  std::array<std::vector<std::uint64_t>, kDegrees> left;
  for (std::size_t c = 0; c < columns; ++c) {
    Past& past = past_[c];
    std::array<std::int64_t, kDegrees> cost_bits = {};
    for (auto& of_degree : left) of_degree.clear();
    for (std::size_t r = 0; r < count; ++r) {
      const std::int64_t bits = OrderedBits(rows[r * columns + c]);
      for (int d = 0; d < kDegrees; ++d) {
        const std::uint64_t rest = ZigZag(Minus(bits, Extrapolate(past.last, d)));
        left[d].push_back(rest);
        cost_bits[d] += std::bit_width(rest);
      }
      Remember(bits, past.last, kHistory);
    }
    const auto best = std::min_element(cost_bits.begin(), cost_bits.end()) - cost_bits.begin();
    degrees[c] = static_cast<char>(best);
    for (const std::uint64_t rest : left[best]) {
      for (std::size_t p = 0; p < planes.size(); ++p) {
        planes[p].push_back(static_cast<char>(rest >> (8 * p)));
      }
    }
  }
  block->push_back(std::move(degrees));
  for (std::string& plane : planes) block->push_back(std::move(plane));
}

bool PackedSeries::Unpack(const Block& block, std::size_t rows, std::size_t* stream,
                          std::vector<double>* out) {
  const std::size_t columns = past_.size();
  if (*stream + kStreams > block.size() || block[*stream].size() != columns) return false;
  const std::string& degrees = block[*stream];
  const std::string* planes = &block[*stream + 1];
  // A damaged block may claim any number of rows.
  if (columns > 0 && rows > planes[0].size() / columns) return false;
  for (std::size_t p = 0; p < sizeof(double); ++p) {
    if (planes[p].size() != rows * columns) return false;
  }
  out->resize(rows * columns);
  for (std::size_t c = 0; c < columns; ++c) {
    Past& past = past_[c];
    const int degree = static_cast<unsigned char>(degrees[c]);
    if (degree >= kDegrees) return false;
    for (std::size_t r = 0; r < rows; ++r) {
      std::uint64_t rest = 0;
      for (std::size_t p = 0; p < sizeof(double); ++p) {
        const auto byte = static_cast<unsigned char>(planes[p][c * rows + r]);
        rest |= static_cast<std::uint64_t>(byte) << (8 * p);
      }
      const std::int64_t bits = Plus(Extrapolate(past.last, degree), FromZigZag(rest));
      Remember(bits, past.last, kHistory);
      (*out)[r * columns + c] = FromOrderedBits(bits);
    }
  }
  *stream += kStreams;
  return true;
}

}  // namespace tera
