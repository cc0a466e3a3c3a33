#pragma once

#include <cstdint>
#include <vector>

namespace tera {

/// One periodic tile of ground detail for close views.
///
/// Model   texel (r, g, b, a): brightness about 128; slopes of the small relief along u and v about
///         128 (255 is slope 1 for a tile of side 1); height of the relief, which darkens the gaps
///         between grains. Relief: smooth noise with stones and clods, as domes of many sizes
///         scattered by a seeded stream.
struct GroundDetail {
  static constexpr int kSide = 512;
  std::vector<std::uint8_t> rgba;
};

GroundDetail MakeGroundDetail();

}  // namespace tera
