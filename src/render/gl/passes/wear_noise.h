#pragma once

#include <cstdint>
#include <vector>

namespace tera {

/// Noise in a periodic cube, for marks that are fixed to a body.
///
/// Model   two channels of value noise: sums of random lattices, each of half the weight of the
///         next coarser one, blended by quintic steps and scaled to mean 1/2 and deviation 0.2. The
///         first is coarse (4 to 32 lattice points a side), the second fine (16 and 32).
/// Source  Perlin 2002, "Improving noise" (the quintic step).
struct WearNoise {
  static constexpr int kSide = 64;
  std::vector<std::uint8_t> rg;  ///< x fastest, then y, then z; two bytes each
};

WearNoise MakeWearNoise();

}  // namespace tera
