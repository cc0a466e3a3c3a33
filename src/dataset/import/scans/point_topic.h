#pragma once

#include <string_view>

#include "dataset/import/bag/bag_source.h"
#include "dataset/import/scans/point_records.h"

namespace tera {

inline constexpr std::string_view kPointCloudType = "sensor_msgs/PointCloud2";

/// Reads a sensor_msgs/PointCloud2. The scan's time is the header's stamp, or `log_ns` with
/// `by_log_time`. Throws BadBytes if the message does not fit its type.
UnitScan ReadPointCloudMessage(const BagTopic& topic, const BagMessage& message,
                               const std::string& place, const PointForm& form, bool by_log_time);

}  // namespace tera
