#pragma once

#include <cstdint>
#include <string_view>

#include "core/motion.h"

namespace tera {

/// A named stream of random numbers. A name is a path, such as `excavator1/imu_boom/gyro_white`.
///
/// Model   Random123 Philox4x32-10. The key is a 64-bit hash of (seed, name); the counter is
///         (index, lane). A draw is a pure function of (seed, name, index, lane). The stream has no
///         hidden state, so evaluation order, thread count and skipped samples do not change a
///         draw.
/// Omits   cryptographic strength.
/// Source  Salmon et al. 2011, "Parallel random numbers: as easy as 1, 2, 3".
class Stream {
 public:
  Stream(std::uint64_t seed, std::string_view name);

  /// Uniform in (0, 1). Different lanes give independent draws at the same index.
  double Uniform(std::uint64_t index, std::uint32_t lane = 0) const;
  /// Standard normal, by Box–Muller from two uniforms with the same counter.
  double Gaussian(std::uint64_t index, std::uint32_t lane = 0) const;
  Vec3 Gaussian3(std::uint64_t index, std::uint32_t lane = 0) const;

 private:
  struct Block {
    std::uint32_t word[4];
  };
  Block Draw(std::uint64_t index, std::uint32_t lane) const;

  std::uint32_t key_[2];
};

/// 64-bit FNV-1a hash, the same on every platform.
std::uint64_t HashText(std::string_view text);

}  // namespace tera
