#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dataset/export/record_stream.h"
#include "dataset/ros/messages.h"

/// Conversion of joint, running gear and cylinder tables to sensor_msgs/JointState.

namespace tera {

/// Column indices of one joint, running gear or cylinder.
struct JointColumns {
  std::string name;
  std::size_t position = 0, rate = 0, effort = 0;
};

/// Index of a column; nullopt if absent.
std::optional<std::size_t> ColumnOf(const std::vector<std::string>& columns,
                                    const std::string& column);
std::string WithoutEnding(const std::string& text, std::string_view ending);

/// Items that have a position, a rate and an effort column. The three endings identify the columns.
/// The result is in the order of the position columns.
std::vector<JointColumns> JointColumnsOf(const std::vector<std::string>& columns,
                                         std::string_view position_ending,
                                         std::string_view rate_ending,
                                         std::string_view effort_ending);

ros::JointState JointStateOf(const std::vector<JointColumns>& joints, const Record& record,
                             const std::string& frame_id, TimeNs stamp_ns);

}  // namespace tera
