#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

namespace tera {

/// Batches of draws from the uniform stream of a given seed and name.
///
/// Model   draw `index` is floor(2^53 u), where u = Stream(seed, name).Uniform(index). Where the
///         processor supports it, several counters run through Philox in parallel (SIMD).
/// Source  see Stream.
class UniformBits {
 public:
  UniformBits(std::uint64_t seed, std::string_view name);

  /// Draws `first`, `first + 1`, and so on.
  void Draw(std::uint64_t first, std::span<std::uint64_t> bits) const;
  /// Same result as Draw, without SIMD.
  void DrawSingly(std::uint64_t first, std::span<std::uint64_t> bits) const;

  static constexpr int kBits = 53;

 private:
  std::array<std::uint32_t, 2> key_;
};

}  // namespace tera
