#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <cstring>
#include <string_view>

#include "core/time.h"
#include "dataset/import/bag/byte_cursor.h"

namespace tera {

/// Reads the fields of a ROS message in order. Throws BadBytes instead of reading beyond the end.
///
/// Model   Supports little-endian CDR without a parameter list, as ROS 2 writes it, and the packed
///         encoding of ROS 1.
class MessageCursor {
 public:
  MessageCursor(std::string_view encoding, std::string_view message)
      : is_cdr_(encoding != "ros1"), bytes_(message) {
    constexpr std::size_t kHeadBytes = 4;
    if (!is_cdr_) return;
    if (message.size() < kHeadBytes || message[0] != 0 || message[1] != 1) {
      throw BadBytes{"it does not begin with the header of little-endian CDR"};
    }
    bytes_.remove_prefix(kHeadBytes);
  }

  template <typename T>
  T Number() {
    if (is_cdr_) at_ = (at_ + sizeof(T) - 1) / sizeof(T) * sizeof(T);
    T value;
    std::memcpy(&value, Bytes(sizeof(T)).data(), sizeof(T));
    return value;
  }
  std::string_view Bytes(std::uint64_t count) {
    if (at_ > bytes_.size() || count > bytes_.size() - at_) {
      throw BadBytes{fmt::format("{} bytes are declared, but {} are left", count,
                                 at_ > bytes_.size() ? 0 : bytes_.size() - at_)};
    }
    const std::string_view bytes = bytes_.substr(at_, count);
    at_ += count;
    return bytes;
  }
  std::string_view Text() {
    std::string_view text = Bytes(Number<std::uint32_t>());
    if (is_cdr_ && text.ends_with('\0')) text.remove_suffix(1);
    return text;
  }
  TimeNs Time() {
    const auto seconds = Number<std::uint32_t>();
    const auto nanoseconds = Number<std::uint32_t>();
    if (nanoseconds >= kNsPerSecond) {
      throw BadBytes{fmt::format("it has a time of {} s and {} ns", seconds, nanoseconds)};
    }
    return TimeNs{seconds} * kNsPerSecond + nanoseconds;
  }
  /// Reads a std_msgs/Header; returns its stamp.
  TimeNs HeaderStamp() {
    if (!is_cdr_) Number<std::uint32_t>();  // sequence number
    const TimeNs stamp_ns = Time();
    Text();
    return stamp_ns;
  }

 private:
  bool is_cdr_;
  std::string_view bytes_;
  std::size_t at_ = 0;
};

}  // namespace tera
