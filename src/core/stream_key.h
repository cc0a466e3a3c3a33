#pragma once

#include <array>
#include <cstdint>

namespace tera {

/// The key under which a stream draws: Philox4x32-10 of its name's hash under the seed.
std::array<std::uint32_t, 2> StreamKey(std::uint64_t seed, std::uint64_t name_hash);

}  // namespace tera
