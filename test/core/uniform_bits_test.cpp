#include "core/uniform_bits.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "core/random.h"

namespace tera {
namespace {

/// Successive draws of a stream.
std::vector<std::uint64_t> FromStream(const Stream& stream, std::uint64_t first, std::size_t n) {
  std::vector<std::uint64_t> bits;
  for (std::size_t k = 0; k < n; ++k) {
    const double whole = std::ldexp(stream.Uniform(first + k), UniformBits::kBits);
    bits.push_back(static_cast<std::uint64_t>(whole));
  }
  return bits;
}

TEST(UniformBits, AreThoseOfTheStreamWhereverTheyBegin) {
  const Stream stream(7, "excavator1/camera_front/rgb");
  const UniformBits many(7, "excavator1/camera_front/rgb");
  // The second start crosses the end of the counter's low word.
  for (const std::uint64_t first : {0ull, 0xffffffffull - 500, 1ull << 40}) {
    std::vector<std::uint64_t> bits(1003);
    many.Draw(first, bits);
    EXPECT_EQ(bits, FromStream(stream, first, bits.size())) << first;
    many.DrawSingly(first, bits);
    EXPECT_EQ(bits, FromStream(stream, first, bits.size())) << first;
  }
}

TEST(UniformBits, OfFewAreTheFirstOfMany) {
  const UniformBits bits(1, "few");
  std::vector<std::uint64_t> many(9), few(3);
  bits.Draw(0, many);
  bits.Draw(0, few);
  EXPECT_EQ(few, std::vector<std::uint64_t>(many.begin(), many.begin() + 3));
  bits.Draw(0, {});
}

}  // namespace
}  // namespace tera
