#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "dataset/export/packets/lidar_pattern.h"
#include "dataset/export/packets/packet_writer.h"

namespace tera {

/// The first difference between a pattern and an Ouster's; empty for an Ouster's.
std::string WhyNotOuster(const LidarPattern& pattern);

/// Writer of `file`.pcap with packets, and of `file`.json with the unit's metadata.
///
/// Frames  the lidar's frame is S turned by 180 deg about z. Simulated beams leave from the origin
///         of S, so the metadata have no offset between beams, lidar and sensor.
/// Model   profile RNG19_RFL8_SIG16_NIR16, or its DUAL form for a lidar of two returns; a scan is a
///         frame. Intensities 0 to 1 map to reflectivities 0 to 255. A packet is sent at the end of
///         its last column.
/// Omits   signal and near infrared, which are 0; packets of the inertial unit.
/// Source  Ouster Firmware User Manual, "Lidar data" and "Sensor metadata".
std::unique_ptr<PacketWriter> MakeOusterWriter(const LidarPattern& pattern, std::uint64_t serial,
                                               const std::filesystem::path& file);

}  // namespace tera
