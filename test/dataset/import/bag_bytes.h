#pragma once

#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <string_view>
#include <vector>

/// Hand-made bytes of messages and MCAP records, from their specifications, independent of the code
/// under test.

namespace tera {

/// Fields of a CDR message, little-endian, with padding.
class Cdr {
 public:
  Cdr() : bytes_("\x00\x01\x00\x00", 4) {}

  template <typename T>
  Cdr& Add(T value) {
    const std::size_t body = bytes_.size() - 4;
    bytes_.append((sizeof value - body % sizeof value) % sizeof value, '\0');
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    bytes_.append(raw, sizeof value);
    return *this;
  }
  Cdr& Text(std::string_view text) {
    Add(static_cast<std::uint32_t>(text.size() + 1));
    bytes_.append(text).push_back('\0');
    return *this;
  }
  /// std_msgs/Header.
  Cdr& Header(std::int32_t seconds, std::uint32_t nanoseconds, std::string_view frame = "f") {
    return Add(seconds).Add(nanoseconds).Text(frame);
  }
  /// All values, without a count.
  Cdr& Numbers(const std::vector<double>& values) {
    for (const double value : values) Add(value);
    return *this;
  }
  Cdr& Sequence(const std::vector<double>& values) {
    Add(static_cast<std::uint32_t>(values.size()));
    return Numbers(values);
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

/// Packed little-endian fields of MCAP records.
class Packed {
 public:
  template <typename T>
  Packed& Add(T value) {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    bytes_.append(raw, sizeof value);
    return *this;
  }
  Packed& Text(std::string_view text) {
    Add(static_cast<std::uint32_t>(text.size()));
    bytes_.append(text);
    return *this;
  }
  Packed& Raw(std::string_view bytes) {
    bytes_.append(bytes);
    return *this;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

inline std::string McapRecord(std::uint8_t opcode, const std::string& content) {
  return Packed().Add(opcode).Add(static_cast<std::uint64_t>(content.size())).bytes() + content;
}

inline const std::string kMcapMagic("\x89MCAP0\r\n", 8);

/// An MCAP file with one topic, /t, without chunks and summary.
class SmallMcap {
 public:
  SmallMcap(const std::string& type, const std::string& definition,
            const std::string& encoding = "ros2msg", const std::string& messages = "cdr") {
    records_ = McapRecord(0x01, Packed().Text("ros2").Text("by hand").bytes());
    records_ += McapRecord(
        0x03, Packed().Add(std::uint16_t{1}).Text(type).Text(encoding).Text(definition).bytes());
    records_ += McapRecord(0x04, Packed()
                                     .Add(std::uint16_t{7})
                                     .Add(std::uint16_t{1})
                                     .Text("/t")
                                     .Text(messages)
                                     .Add(std::uint32_t{0})
                                     .bytes());
  }
  SmallMcap& Message(std::uint64_t log_ns, const std::string& bytes) {
    records_ += MessageRecord(log_ns, bytes);
    return *this;
  }
  SmallMcap& Raw(const std::string& record) {
    records_ += record;
    return *this;
  }
  static std::string MessageRecord(std::uint64_t log_ns, const std::string& bytes) {
    return McapRecord(0x05, Packed()
                                .Add(std::uint16_t{7})
                                .Add(std::uint32_t{0})
                                .Add(log_ns)
                                .Add(log_ns)
                                .Raw(bytes)
                                .bytes());
  }
  std::string WithoutEnd() const { return kMcapMagic + records_; }
  std::string bytes() const {
    return WithoutEnd() + McapRecord(0x0F, Packed().Add(std::uint32_t{0}).bytes()) +
           McapRecord(
               0x02,
               Packed().Add(std::uint64_t{0}).Add(std::uint64_t{0}).Add(std::uint32_t{0}).bytes()) +
           kMcapMagic;
  }

 private:
  std::string records_;
};

/// An MCAP file with several topics of types known to TERA, without chunks and summary.
class TopicsMcap {
 public:
  TopicsMcap() : records_(McapRecord(0x01, Packed().Text("ros2").Text("by hand").bytes())) {}

  TopicsMcap& Message(const std::string& topic, const std::string& type, std::int64_t log_ns,
                      const Cdr& message) {
    auto [id, is_new] = ids_.try_emplace(topic, static_cast<std::uint16_t>(ids_.size() + 1));
    if (is_new) Offer(id->second, topic, type);
    records_ += McapRecord(0x05, Packed()
                                     .Add(id->second)
                                     .Add(std::uint32_t{0})
                                     .Add(log_ns)
                                     .Add(log_ns)
                                     .Raw(message.bytes())
                                     .bytes());
    return *this;
  }
  std::string bytes() const {
    return kMcapMagic + records_ + McapRecord(0x0F, Packed().Add(std::uint32_t{0}).bytes()) +
           McapRecord(
               0x02,
               Packed().Add(std::uint64_t{0}).Add(std::uint64_t{0}).Add(std::uint32_t{0}).bytes()) +
           kMcapMagic;
  }

 private:
  void Offer(std::uint16_t id, const std::string& topic, const std::string& type) {
    records_ += McapRecord(0x03, Packed().Add(id).Text(type).Text("").Text("").bytes());
    records_ += McapRecord(
        0x04, Packed().Add(id).Add(id).Text(topic).Text("cdr").Add(std::uint32_t{0}).bytes());
  }

  std::string records_;
  std::map<std::string, std::uint16_t> ids_;
};

}  // namespace tera
