#pragma once

#include <filesystem>
#include <string_view>

#include "dataset/import/bag/bag_source.h"
#include "dataset/import/scans/unit_packet.h"

namespace tera {

inline constexpr std::string_view kVelodyneType = "velodyne_msgs/VelodyneScan";
inline constexpr std::string_view kPandarType = "pandar_msgs/PandarScan";
/// Message types of Ouster's drivers. A message holds one packet.
inline constexpr std::string_view kOusterType = "ouster_ros/PacketMsg",
                                  kOusterMsgsType = "ouster_msgs/PacketMsg",
                                  kOusterSensorType = "ouster_sensor_msgs/PacketMsg";

/// True for message types that contain lidar packets.
bool HoldsPackets(std::string_view type);

/// Passes each message of a topic to `take`, with its place for error messages. BadBytes becomes an
/// InputError with that place. With `skips_bad`, unreadable messages and damage of the bag are
/// reported to `leave_out`.
using TakeMessage = std::function<void(const BagMessage& message, const std::string& place)>;
void ReadMessages(const std::filesystem::path& bag, const BagTopic& topic, UnpackedFiles* unpacked,
                  bool skips_bad, const LeaveOut& leave_out, const TakeMessage& take);

/// Passes the packets of such a topic to `take`, in order. Packets of Ouster's drivers have no
/// stamp; their time of reception is the recording time in the bag.
void ReadPacketTopic(const std::filesystem::path& bag, const BagTopic& topic,
                     UnpackedFiles* unpacked, bool skips_bad, const LeaveOut& leave_out,
                     const TakePacket& take);

}  // namespace tera
