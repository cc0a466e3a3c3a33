#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace tera {

/// Layout of a Velodyne's packet: 12 blocks of a flag, an azimuth in 0.01 deg and 32 returns, each
/// of a range and a reflectivity; then microseconds since the hour, return mode and factory byte.
///
/// Source  VLP-16 User Manual 63-9243, section 9.3.
struct VelodyneLayout {
  static constexpr std::size_t kBlocks = 12, kBlockBytes = 100, kBlockHead = 4, kReturnBytes = 3;
  static constexpr std::size_t kReturnsPerBlock = 32;
  static constexpr std::size_t kStampAt = 1200, kModeAt = 1204, kFactoryAt = 1205;
  static constexpr std::size_t kPacketBytes = 1206;
  static constexpr std::uint16_t kBlockFlag = 0xeeff;
  static constexpr std::uint8_t kStrongest = 0x37, kLast = 0x38, kDual = 0x39;
  static constexpr double kSequence_us = 55.296;  ///< firings of all lasers, and the pause
};

/// Data-sheet values of a Velodyne's lasers, in packet order.
struct VelodyneUnit {
  std::string_view name;
  std::uint8_t factory_byte = 0;
  double range_step_m = 0.002;
  int sequences_per_block = 1;  ///< firings of all lasers
  std::vector<double> elevation_deg, azimuth_offset_deg;
  std::vector<double> origin_z_m;  ///< height of each beam above the sensor's origin
  std::vector<double> firing_us;   ///< after the start of the sequence
};

/// Source  VLP-16 User Manual 63-9243, table 9-1 and section 9.4; VLP-32C User Manual 63-9325,
///         tables 9-2 and 9-6 and figures 9-7 and 9-8.
const VelodyneUnit& Vlp16();
const VelodyneUnit& Vlp32c();

}  // namespace tera
