#pragma once

#include <filesystem>
#include <string_view>

#include "dataset/import/bag/bag_source.h"
#include "dataset/import/scans/unit_packet.h"

namespace tera {

inline constexpr std::string_view kVelodyneType = "velodyne_msgs/VelodyneScan";
inline constexpr std::string_view kPandarType = "pandar_msgs/PandarScan";
/// Of Ouster's drivers: one packet a message.
inline constexpr std::string_view kOusterType = "ouster_ros/PacketMsg",
                                  kOusterMsgsType = "ouster_msgs/PacketMsg",
                                  kOusterSensorType = "ouster_sensor_msgs/PacketMsg";

/// Whether the messages of a type hold the packets of a lidar.
bool HoldsPackets(std::string_view type);

/// Each message of a topic with what stands in its place; its faults are InputErrors of a place in
/// the message. Messages that cannot be read go to `leave_out`, and so does damage of the bag.
using TakeMessage = std::function<void(const BagMessage& message, const std::string& place)>;
void ReadMessages(const std::filesystem::path& bag, const BagTopic& topic, UnpackedFiles* unpacked,
                  bool skips_bad, const LeaveOut& leave_out, const TakeMessage& take);

/// Shows the packets of a topic of such a type, in their order. A packet of Ouster's driver, which
/// has no stamp, was received when the bag recorded it.
void ReadPacketTopic(const std::filesystem::path& bag, const BagTopic& topic,
                     UnpackedFiles* unpacked, bool skips_bad, const LeaveOut& leave_out,
                     const TakePacket& take);

}  // namespace tera
