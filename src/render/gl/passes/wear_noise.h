#pragma once

#include <cstdint>
#include <vector>

namespace tera {

/// Noise in a periodic cube, for marks fixed to a body.
///
/// Model   two channels of value noise: sums of random lattices with quintic blending. Each lattice
///         has half the weight of the next coarser lattice. The sum has mean 1/2 and deviation 0.2.
///         The first channel is coarse (4 to 32 lattice points per side), the second fine (16 and
///         32).
/// Source  Perlin 2002, "Improving noise" (the quintic step).
struct WearNoise {
  static constexpr int kSide = 64;
  std::vector<std::uint8_t> rg;  ///< x fastest, then y, then z; two bytes each
};

WearNoise MakeWearNoise();

}  // namespace tera
