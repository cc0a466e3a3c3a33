#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
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

/// Writes a number in the same way.
template <typename T>
void PutPacketNumber(T value, std::size_t at, std::string* bytes) {
  TERA_CHECK(at + sizeof(T) <= bytes->size(), at, bytes->size());
  std::memcpy(bytes->data() + at, &value, sizeof(T));
}

/// Full scale of calibrated reflectivities in 8 bits.
inline constexpr float kFullReflectivity = 255.0F;

}  // namespace tera
