#pragma once

#include <array>
#include <cstdint>

namespace tera {

/// Philox4x32-10 key of a stream from the seed and the hash of its name.
std::array<std::uint32_t, 2> StreamKey(std::uint64_t seed, std::uint64_t name_hash);

}  // namespace tera
