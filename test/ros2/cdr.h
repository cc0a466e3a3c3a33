#pragma once

#include <fastcdr/Cdr.h>

#include <array>
#include <string>
#include <vector>

#include "ros2/fast_peer.h"

namespace tera {

/// Reads a payload field by field with Fast CDR, in the order of the ROS definition. Throws Fast
/// CDR's exception if the payload ends too soon.
class CdrReader {
 public:
  explicit CdrReader(Payload payload)
      : payload_(std::move(payload)),
        buffer_(reinterpret_cast<char*>(payload_.data()), payload_.size()),
        cdr_(buffer_, eprosima::fastcdr::Cdr::DEFAULT_ENDIAN, eprosima::fastcdr::Cdr::DDS_CDR) {
    cdr_.read_encapsulation();
  }
  CdrReader(const CdrReader&) = delete;
  CdrReader& operator=(const CdrReader&) = delete;

  template <typename T>
  T Get() {
    T value = {};
    cdr_ >> value;
    return value;
  }
  double F64() { return Get<double>(); }
  float F32() { return Get<float>(); }
  std::uint32_t U32() { return Get<std::uint32_t>(); }
  std::int32_t I32() { return Get<std::int32_t>(); }
  std::string Text() { return Get<std::string>(); }

  template <std::size_t N>
  std::array<double, N> Array() {
    return Get<std::array<double, N>>();
  }
  /// Seconds since 0 of a builtin_interfaces/Time, in nanoseconds.
  std::int64_t Time() {
    const std::int64_t seconds = I32();
    return seconds * 1'000'000'000 + U32();
  }
  /// At most three bytes of padding remain.
  bool AtEnd() { return payload_.size() - cdr_.getSerializedDataLength() < 4; }

 private:
  Payload payload_;
  eprosima::fastcdr::FastBuffer buffer_;
  eprosima::fastcdr::Cdr cdr_;
};

/// tera_msgs/msg/DeltaCAN as a ROS node would send it.
struct LeverMessage {
  std::int32_t stamp_sec = 0;
  std::uint32_t stamp_nanosec = 0;
  std::string frame_id;
  float slew = 0, boom = 0, arm = 0, bucket = 0;
  float left_travel = 0, right_travel = 0, blade = 0, swing = 0;
  bool enable = true, hydraulic_lock = false, high_speed = false;
  std::vector<float> others;

  Payload Encode() const {
    Payload payload(256);
    eprosima::fastcdr::FastBuffer buffer(reinterpret_cast<char*>(payload.data()), payload.size());
    eprosima::fastcdr::Cdr cdr(buffer, eprosima::fastcdr::Cdr::DEFAULT_ENDIAN,
                               eprosima::fastcdr::Cdr::DDS_CDR);
    cdr.serialize_encapsulation();
    cdr << stamp_sec << stamp_nanosec << frame_id;
    cdr << slew << boom << arm << bucket << left_travel << right_travel << blade << swing;
    cdr << enable << hydraulic_lock << high_speed << others;
    payload.resize(cdr.getSerializedDataLength());
    return payload;
  }
};

}  // namespace tera
