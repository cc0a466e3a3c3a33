#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "dataset/export/packets/lidar_pattern.h"
#include "dataset/export/packets/packet_writer.h"
#include "dataset/import/scans/velodyne_units.h"

namespace tera {

/// The first difference between a pattern and a unit's; empty if the unit has this pattern.
std::string WhyNotVelodyne(const LidarPattern& pattern, const VelodyneUnit& unit);

/// Writer of `file`.pcap for a pattern that is the unit's.
///
/// Model   a column is a firing sequence. Packets go on from scan to scan; a last packet that is
///         not full, or one before a gap, is filled with columns that have no return. A lidar of
///         two returns sends pairs of blocks: the farther return, then the nearer one, or the only
///         one twice. Intensities 0 to 1 map to 0 to 255. A packet is sent at the end of its last
///         sequence; its stamp is the time of its first.
/// Source  the manuals of velodyne_units.h.
std::unique_ptr<PacketWriter> MakeVelodyneWriter(const VelodyneUnit& unit,
                                                 const LidarPattern& pattern,
                                                 const std::filesystem::path& file);

}  // namespace tera
