#pragma once

#include <cstdint>
#include <vector>

namespace tera {

/// Periodic 3D noise for wear marks that are fixed to a body.
///
/// Model   two channels of value noise: sums of random lattices with quintic interpolation. Each
///         lattice has half the weight of the next coarser one. The sum has mean 1/2 and standard
///         deviation 0.2. The first channel is coarse (4 to 32 lattice points per side), the second
///         fine (16 and 32).
/// Source  Perlin 2002, "Improving noise" (the quintic step).
struct WearNoise {
  static constexpr int kSide = 64;
  std::vector<std::uint8_t> rg;  ///< two bytes per point; x fastest, then y, then z
};

WearNoise MakeWearNoise();

}  // namespace tera
