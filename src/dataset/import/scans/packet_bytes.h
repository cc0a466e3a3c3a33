#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <string_view>

#include "core/check.h"

namespace tera {

static_assert(std::endian::native == std::endian::little, "packets of lidars are little-endian");

/// Little-endian number at byte `at` of a packet. The caller must check the length.
template <typename T>
T PacketNumber(std::string_view bytes, std::size_t at) {
  TERA_CHECK(at + sizeof(T) <= bytes.size(), at, bytes.size());
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof(T));
  return value;
}

/// Largest calibrated reflectivity in 8 bits.
inline constexpr float kFullReflectivity = 255.0F;

}  // namespace tera
