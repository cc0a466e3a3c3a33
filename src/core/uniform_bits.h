#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

namespace tera {

/// Batches of uniform draws of a named stream.
///
/// Model   draw `index` of (seed, name) is floor(2^53 u), where u is the Stream::Uniform(index) of
///         the same seed and name. Where the processor supports it, Philox processes several
///         counters in parallel.
/// Source  see Stream.
class UniformBits {
 public:
  UniformBits(std::uint64_t seed, std::string_view name);

  /// Draws `first`, `first + 1`, and so on.
  void Draw(std::uint64_t first, std::span<std::uint64_t> bits) const;
  /// Scalar version of Draw: processes one counter after another.
  void DrawSingly(std::uint64_t first, std::span<std::uint64_t> bits) const;

  static constexpr int kBits = 53;

 private:
  std::array<std::uint32_t, 2> key_;
};

}  // namespace tera
