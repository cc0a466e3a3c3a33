#include "core/random.h"

#include <Random123/philox.h>

#include <cmath>

#include "core/stream_key.h"
#include "core/units.h"

namespace tera {
namespace {

/// Uniform in (0, 1) from 53 bits of two words; excludes 0 and 1.
double UnitOpen(std::uint32_t high, std::uint32_t low) {
  const std::uint64_t bits = ((static_cast<std::uint64_t>(high) << 32) | low) >> 11;
  return (static_cast<double>(bits) + 0.5) * 0x1.0p-53;
}

}  // namespace

std::uint64_t HashText(std::string_view text) {
  std::uint64_t hash = 14695981039346656037ull;
  for (const char c : text) {
    hash ^= static_cast<unsigned char>(c);
    hash *= 1099511628211ull;
  }
  return hash;
}

Stream::Stream(std::uint64_t seed, std::string_view name) {
  const auto key = StreamKey(seed, HashText(name));
  key_[0] = key[0];
  key_[1] = key[1];
}

Stream::Block Stream::Draw(std::uint64_t index, std::uint32_t lane) const {
  const r123::Philox4x32::ctr_type counter = {
      {static_cast<std::uint32_t>(index), static_cast<std::uint32_t>(index >> 32), lane, 0}};
  const auto out = r123::Philox4x32()(counter, r123::Philox4x32::key_type{{key_[0], key_[1]}});
  return {{out[0], out[1], out[2], out[3]}};
}

double Stream::Uniform(std::uint64_t index, std::uint32_t lane) const {
  const Block block = Draw(index, lane);
  return UnitOpen(block.word[0], block.word[1]);
}

double Stream::Gaussian(std::uint64_t index, std::uint32_t lane) const {
  const Block block = Draw(index, lane);
  const double radius = std::sqrt(-2.0 * std::log(UnitOpen(block.word[0], block.word[1])));
  return radius * std::cos(2.0 * kPi * UnitOpen(block.word[2], block.word[3]));
}

Vec3 Stream::Gaussian3(std::uint64_t index, std::uint32_t lane) const {
  return {Gaussian(index, 3 * lane), Gaussian(index, 3 * lane + 1), Gaussian(index, 3 * lane + 2)};
}

}  // namespace tera
