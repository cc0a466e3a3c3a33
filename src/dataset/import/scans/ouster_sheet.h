#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/motion.h"

namespace tera {

/// Byte layout of a pixel in the packets of a profile. Offsets count from the start of the pixel.
struct OusterPixel {
  std::size_t bytes = 0;
  std::uint32_t range_mask = 0;
  double range_step_m = 0.001;
  struct Return {
    std::size_t range_at = 0, reflectivity_at = 0;
  };
  std::vector<Return> returns;  ///< strongest return first
};

/// The pixel of a profile, "RNG15_RFL8_NIR8"; null for an unknown profile.
const OusterPixel* OusterPixelOf(const std::string& profile);

/// Bytes before the columns of a packet and before the pixels of a column, other than LEGACY.
inline constexpr std::size_t kOusterPacketHead = 32, kOusterColumnHead = 12;

/// Metadata of an Ouster.
///
/// Source  Ouster Firmware User Manual, "Sensor metadata", "Lidar data" and "Coordinate frames".
struct OusterSheet {
  std::string product;       ///< such as "OS-1-128"
  std::uint64_t serial = 0;  ///< 0: unknown
  std::string profile;       ///< such as "RNG15_RFL8_NIR8"; packets of "LEGACY" have no header
  bool is_legacy = false, is_fusa = false;
  OusterPixel pixel;
  int columns_per_packet = 16, columns_per_frame = 1024, beams = 0;
  int first_column = 0, last_column = 0;  ///< azimuth window of columns that the unit sends
  double rate_hz = 10;
  int port = 7502;
  std::vector<double> altitude_rad, azimuth_rad;  ///< one per beam
  double beam_x_m = 0, beam_z_m = 0;              ///< origin of the beams in the lidar frame
  Pose X_SL = Pose::Identity();                   ///< pose of the lidar frame in the sensor frame

  std::size_t column_bytes() const;
  std::size_t packet_bytes() const;
};

/// Reads metadata in the old or the new form, as written by the sensor's HTTP interface and
/// Ouster's tools. Throws InputError for missing or contradictory keys and unknown profiles.
OusterSheet ReadOusterSheet(const std::filesystem::path& file);

}  // namespace tera
