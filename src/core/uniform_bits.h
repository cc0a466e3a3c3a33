#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

namespace tera {

/// Many uniform draws of a named stream at once.
///
/// Model   draw `index` of (seed, name) is floor(2^53 u), u what Stream::Uniform(index) of the same
///         seed and name gives; several counters go through Philox side by side where the processor
///         can.
/// Source  as of Stream.
class UniformBits {
 public:
  UniformBits(std::uint64_t seed, std::string_view name);

  /// Draws `first`, `first + 1` and so on.
  void Draw(std::uint64_t first, std::span<std::uint64_t> bits) const;
  /// The same, one counter after the other.
  void DrawSingly(std::uint64_t first, std::span<std::uint64_t> bits) const;

  static constexpr int kBits = 53;

 private:
  std::array<std::uint32_t, 2> key_;
};

}  // namespace tera
