#pragma once

#include <cstdint>
#include <vector>

namespace tera {

/// A periodic tile of fine ground detail for close views.
///
/// Model   the relief is smooth noise plus stones and clods: domes of many sizes at seeded random
///         places. A texel has four channels. r: brightness, 128 is neutral. g, b: slopes of the
///         relief along u and v, 128 is level, 255 is slope 1 for a tile of side 1. a: height of
///         the relief, with which the shader darkens the gaps between grains.
struct GroundDetail {
  static constexpr int kSide = 512;
  std::vector<std::uint8_t> rgba;
};

GroundDetail MakeGroundDetail();

}  // namespace tera
