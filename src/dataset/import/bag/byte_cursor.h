#pragma once

#include <fmt/format.h>

#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>

namespace tera {

/// Thrown for bytes that violate their format or schema. The caller adds the place and rethrows an
/// InputError.
struct BadBytes {
  std::string finding;
};

/// Reads little-endian numbers and texts from a byte sequence. Throws BadBytes instead of reading
/// beyond its end.
class ByteCursor {
 public:
  explicit ByteCursor(std::string_view bytes) : bytes_(bytes) {}

  std::size_t remaining() const { return bytes_.size() - at_; }
  std::size_t at() const { return at_; }

  std::string_view Bytes(std::uint64_t count) {
    if (count > remaining()) {
      throw BadBytes{fmt::format("{} bytes are declared, but {} are left", count, remaining())};
    }
    const std::string_view bytes = bytes_.substr(at_, count);
    at_ += count;
    return bytes;
  }
  template <std::unsigned_integral T>
  T Number() {
    T value = 0;
    const std::string_view bytes = Bytes(sizeof value);
    for (std::size_t k = 0; k < sizeof value; ++k) {
      value = static_cast<T>(
          value | static_cast<T>(static_cast<T>(static_cast<unsigned char>(bytes[k])) << (8 * k)));
    }
    return value;
  }
  /// A text preceded by its length as a 32-bit number.
  std::string_view Text() { return Bytes(Number<std::uint32_t>()); }

 private:
  std::string_view bytes_;
  std::size_t at_ = 0;
};

}  // namespace tera
