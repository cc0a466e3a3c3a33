#pragma once

#include <cstdint>
#include <vector>

namespace tera {

/// One tile of ground as seen from close up, repeating in both directions.
///
/// Model   texel (r, g, b, a): brightness about 128; slopes of the small relief along u and v about
///         128 (255 is slope 1 for a tile of side 1); height of that relief, for the dark between
///         the grains. Relief: smooth noise with stones and clods, domes of many sizes scattered by
///         a seeded stream.
struct GroundDetail {
  static constexpr int kSide = 512;
  std::vector<std::uint8_t> rgba;
};

GroundDetail MakeGroundDetail();

}  // namespace tera
