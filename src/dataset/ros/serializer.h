#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "dataset/ros/message_fields.h"

namespace tera::ros {

/// Encoding of messages.
enum class WireForm {
  kCdr,  ///< ROS 2: aligned, preceded by four bytes that identify the encoding
  kRos1  ///< ROS 1: packed
};

/// Serialises messages in little-endian order.
///
/// Model   kCdr: a number of n bytes is aligned to a multiple of n, counted after the first four
///         bytes. A string includes a final 0, which counts in its length. kRos1: no padding and no
///         final 0. Both: a sequence is preceded by its length in 32 bits, an array is not.
/// Source  OMG CORBA 3.3, part 2, section 9.3 (CDR), with DDS-RTPS 2.3, section 10.2 for the first
///         four bytes; "ROS message serialization" of the ROS 1 wiki.
class Serializer {
 public:
  explicit Serializer(WireForm form) : form_(form) { Clear(); }

  WireForm form() const { return form_; }
  const std::string& bytes() const { return bytes_; }
  /// Moves the bytes of the last message out.
  std::string TakeBytes() { return std::move(bytes_); }
  void Clear() {
    bytes_.clear();
    if (form_ == WireForm::kCdr) bytes_.append(kLittleEndianCdr);
  }

  template <typename T>
  requires std::is_arithmetic_v<T> || std::is_enum_v<T>
  void Put(T value) {
    Align(sizeof value);
    Append(&value, sizeof value);
  }
  void Put(bool value) { Put(static_cast<std::uint8_t>(value)); }
  void Put(const std::string& text) {
    const std::size_t end = form_ == WireForm::kCdr ? 1 : 0;
    PutLength(text.size() + end);
    Append(text.c_str(), text.size() + end);
  }
  template <typename T>
  requires std::is_arithmetic_v<T>
  void Put(std::span<const T> sequence) {
    PutLength(sequence.size());
    PutAll(sequence.data(), sequence.size());
  }
  template <typename T>
  void Put(const std::vector<T>& sequence) {
    if constexpr (std::is_arithmetic_v<T>) {
      Put(std::span<const T>(sequence));
    } else {
      PutLength(sequence.size());
      for (const T& item : sequence) Put(item);
    }
  }
  template <typename T, std::size_t n>
  void Put(const std::array<T, n>& values) {
    PutAll(values.data(), n);
  }
  void Put(const Bytes& bytes) {
    PutLength(bytes.data.size());
    Append(bytes.data.data(), bytes.data.size());
  }
  /// Writes the fields of a message or a part. The sequence number in a ROS 1 header is 0.
  template <HasFields T>
  void Put(const T& message) {
    if (form_ == WireForm::kRos1 && T::kType == Header::kType) Put(std::uint32_t{0});
    Fields(*this, message);
  }
  /// Called by Fields for each field.
  template <typename T>
  void operator()(std::string_view, const T& value) {
    Put(value);
  }
  void Constant(std::string_view) {}

 private:
  void PutLength(std::size_t length) { Put(static_cast<std::uint32_t>(length)); }
  static_assert(std::endian::native == std::endian::little, "numbers are copied as they stand");
  static constexpr std::string_view kLittleEndianCdr{"\x00\x01\x00\x00", 4};

  void Align(std::size_t size) {
    if (form_ != WireForm::kCdr) return;
    const std::size_t at = bytes_.size() - kLittleEndianCdr.size();
    bytes_.append((size - at % size) % size, '\0');
  }
  template <typename T>
  void PutAll(const T* values, std::size_t count) {
    if (count == 0) return;
    Align(sizeof(T));
    Append(values, count * sizeof(T));
  }
  void Append(const void* data, std::size_t size) {
    bytes_.append(static_cast<const char*>(data), size);
  }

  WireForm form_;
  std::string bytes_;
};

}  // namespace tera::ros
