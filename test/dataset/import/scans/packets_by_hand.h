#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

/// Hand-made lidar packets and captures, from their manuals, independent of the code under test.

namespace tera {

template <typename T>
void PutAt(std::string* bytes, std::size_t at, T value) {
  if (bytes->size() < at + sizeof value) bytes->resize(at + sizeof value);
  std::memcpy(bytes->data() + at, &value, sizeof value);
}
template <typename T>
std::string Bytes(T value) {
  std::string bytes;
  PutAt(&bytes, 0, value);
  return bytes;
}
inline std::string Swapped16(std::uint16_t value) {
  return {static_cast<char>(value >> 8), static_cast<char>(value & 0xff)};
}

/// UDP in IPv4 in Ethernet. `fragment` is the offset and flags as they stand in the IP header.
inline std::string Ipv4(const std::string& payload, std::uint16_t fragment = 0,
                        std::uint8_t protocol = 17) {
  std::string ip = "\x45" + std::string(1, '\0') +
                   Swapped16(static_cast<std::uint16_t>(20 + payload.size())) + "\x12\x34" +
                   Swapped16(fragment) + "\x40" + static_cast<char>(protocol) +
                   std::string(2, '\0') + std::string("\xc0\xa8\x01\xc9\xc0\xa8\x01\x02", 8);
  return std::string(12, '\x02') + std::string("\x08\x00", 2) + ip + payload;
}
inline std::string Udp(const std::string& payload, std::uint16_t port) {
  return Swapped16(40000) + Swapped16(port) +
         Swapped16(static_cast<std::uint16_t>(8 + payload.size())) + std::string(2, '\0') + payload;
}

/// A pcap file of Ethernet frames, with a resolution of 1 us.
class PcapByHand {
 public:
  PcapByHand() {
    bytes_ = Bytes(0xa1b2c3d4U) + Bytes(std::uint16_t{2}) + Bytes(std::uint16_t{4}) +
             std::string(8, '\0') + Bytes(262144U) + Bytes(1U);
  }
  PcapByHand& Frame(double t_s, const std::string& frame) {
    const auto seconds = static_cast<std::uint32_t>(t_s);
    const auto size = static_cast<std::uint32_t>(frame.size());
    bytes_ += Bytes(seconds) + Bytes(static_cast<std::uint32_t>((t_s - seconds) * 1e6 + 0.5)) +
              Bytes(size) + Bytes(size) + frame;
    return *this;
  }
  PcapByHand& Packet(double t_s, const std::string& payload, std::uint16_t port = 2368) {
    return Frame(t_s, Ipv4(Udp(payload, port)));
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

/// One packet of a VLP-16: 12 blocks of 32 returns.
class Vlp16Packet {
 public:
  Vlp16Packet(std::uint32_t in_hour_us, double azimuth_deg, double step_deg,
              std::uint8_t mode = 0x37, std::uint8_t factory = 0x22)
      : bytes_(1206, '\0') {
    for (std::size_t b = 0; b < 12; ++b) {
      double a = azimuth_deg + step_deg * static_cast<double>(mode == 0x39 ? b / 2 : b);
      if (a >= 360) a -= 360;
      PutAt(&bytes_, 100 * b, std::uint16_t{0xeeff});
      PutAt(&bytes_, 100 * b + 2, static_cast<std::uint16_t>(a * 100 + 0.5));
    }
    PutAt(&bytes_, 1200, in_hour_us);
    PutAt(&bytes_, 1204, mode);
    PutAt(&bytes_, 1205, factory);
  }
  /// The k-th of a block's 32 returns.
  Vlp16Packet& Return(std::size_t block, std::size_t k, std::uint16_t range,
                      std::uint8_t reflectivity) {
    PutAt(&bytes_, 100 * block + 4 + 3 * k, range);
    PutAt(&bytes_, 100 * block + 6 + 3 * k, reflectivity);
    return *this;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

/// One packet of a QT64 in single-return mode (strongest).
inline std::string Qt64Packet(double azimuth_deg, std::uint32_t us, std::size_t laser,
                              std::uint16_t range, std::uint8_t reflectivity) {
  std::string bytes(1068, '\0');
  const std::array<std::uint8_t, 12> head = {0xee, 0xff, 3, 1, 0, 0, 64, 4, 0, 4, 1, 0};
  for (std::size_t k = 0; k < head.size(); ++k) PutAt(&bytes, k, head[k]);
  for (std::size_t b = 0; b < 4; ++b) {
    PutAt(&bytes, 12 + 258 * b,
          static_cast<std::uint16_t>(100 * (azimuth_deg + 0.6 * static_cast<double>(b)) + 0.5));
  }
  PutAt(&bytes, 12 + 2 + 4 * laser, range);
  PutAt(&bytes, 12 + 4 + 4 * laser, reflectivity);
  PutAt(&bytes, 1044 + 12, us);
  PutAt(&bytes, 1044 + 16, std::uint8_t{0x37});
  const std::array<std::uint8_t, 6> date = {123, 1, 11, 10, 20, 30};  // 2023-01-11 10:20:30
  for (std::size_t k = 0; k < date.size(); ++k) PutAt(&bytes, 1044 + 18 + k, date[k]);
  return bytes;
}

/// Metadata of a small Ouster with two beams and eight columns per turn, two in a packet.
inline std::string OusterMetadata(const std::string& profile, const std::string& mode = "8x10") {
  return R"({"prod_line": "OS-0-2", "lidar_mode": ")" + mode +
         R"(", "beam_altitude_angles": [30, -10], "beam_azimuth_angles": [3, -3],
    "lidar_origin_to_beam_origin_mm": 20,
    "lidar_to_sensor_transform": [-1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1, 40, 0, 0, 0, 1],
    "udp_port_lidar": 7502,
    "data_format": {"columns_per_frame": 8, "columns_per_packet": 2, "pixels_per_column": 2,
                    "column_window": [0, 7], "udp_profile_lidar": ")" +
         profile + R"("}})";
}

/// One column: its number, its stamp and the bytes of its pixels.
struct OusterColumn {
  std::uint16_t number = 0;
  std::uint64_t t_ns = 0;
  std::string pixels;
  bool is_valid = true;
};

/// A packet with header and footer.
inline std::string OusterPacket(std::uint16_t frame, const std::vector<OusterColumn>& columns) {
  std::string bytes(32, '\0');
  PutAt(&bytes, 0, std::uint16_t{1});
  PutAt(&bytes, 2, frame);
  for (const OusterColumn& column : columns) {
    bytes += Bytes(column.t_ns) + Bytes(column.number) +
             Bytes(static_cast<std::uint16_t>(column.is_valid ? 1 : 0)) + column.pixels;
  }
  return bytes + std::string(32, '\0');
}

/// A packet of the legacy profile, without header.
inline std::string LegacyOusterPacket(std::uint16_t frame,
                                      const std::vector<OusterColumn>& columns) {
  std::string bytes;
  for (const OusterColumn& column : columns) {
    bytes += Bytes(column.t_ns) + Bytes(column.number) + Bytes(frame) +
             Bytes(std::uint32_t{column.number * 88U}) + column.pixels +
             Bytes(column.is_valid ? 0xffffffffU : 0U);
  }
  return bytes;
}

}  // namespace tera
