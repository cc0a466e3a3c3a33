#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>

namespace tera {

/// Appends an integer to `bytes` with the low byte first.
template <std::unsigned_integral T>
void AppendNumber(T value, std::string* bytes) {
  std::array<char, sizeof(T)> parts;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    parts[k] = static_cast<char>(static_cast<unsigned char>((value >> (8 * k)) & 0xff));
  }
  bytes->append(parts.data(), parts.size());
}

/// Appends the length of the text as a 32-bit number, then the text.
inline void AppendText(std::string_view text, std::string* bytes) {
  AppendNumber(static_cast<std::uint32_t>(text.size()), bytes);
  bytes->append(text);
}

}  // namespace tera
