#pragma once

#include <string_view>

#include "dataset/import/bag/bag_source.h"
#include "dataset/import/scans/point_records.h"

namespace tera {

inline constexpr std::string_view kPointCloudType = "sensor_msgs/PointCloud2";

/// Whether the messages of a type hold points: sensor_msgs/PointCloud2, and CustomMsg of
/// livox_ros_driver, livox_ros_driver2 and livox_interfaces.
bool HoldsPoints(std::string_view type);

/// The scan of one message that holds points. Its stamp is the header's, or `log_ns` with
/// `by_log_time`. Throws BadBytes where the message violates its type.
UnitScan ReadPointMessage(const BagTopic& topic, const BagMessage& message,
                          const std::string& place, const PointForm& form, bool by_log_time);

}  // namespace tera
