#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dataset/import/bag/bag_source.h"

/// Assignment of fields of ROS's standard messages, and of logs of known form, to the columns of a
/// channel. A mapping need not repeat it.

namespace tera {

struct StandardColumn {
  std::string path;
  double factor = 1.0;    ///< SI units per unit of the field
  bool may_lack = false;  ///< as for a receiver's position without a fix
};

/// The field of a type for a mapping's key such as "wx" or "lat". None if the type alone cannot
/// form a channel with that key. Types that can: sensor_msgs/Imu, sensor_msgs/NavSatFix,
/// nav_msgs/Odometry, geometry_msgs/PoseStamped, geometry_msgs/PoseWithCovarianceStamped,
/// geometry_msgs/TransformStamped, the types of foreign_log.h, and the transforms within messages
/// of several.
std::optional<StandardColumn> StandardColumnOf(std::string_view type, std::string_view key);

inline constexpr std::string_view kImuType = "sensor_msgs/Imu";
inline constexpr std::string_view kFixType = "sensor_msgs/NavSatFix";
inline constexpr std::string_view kJointType = "sensor_msgs/JointState";
/// Field of kFixType: whether the covariance is known, nonzero if so.
inline constexpr const char* kCovarianceTypePath = "position_covariance_type";

/// Whether the messages of a type are lists of transforms: tf2_msgs/TFMessage, tf/tfMessage.
bool HoldsTransforms(std::string_view type);
/// The path of a transform, "transforms[odom>base_link]."
std::string PathOfTransform(const std::string& parent, const std::string& child);

/// Counts the messages of a topic by the names in them: the joints of each, or each transform as
/// "odom>base_link". Skips unreadable messages.
std::map<std::vector<std::string>, std::int64_t> NamesInMessages(const std::filesystem::path& bag,
                                                                 const BagTopic& topic,
                                                                 UnpackedFiles* unpacked);

/// The joints in the first message of a topic of kJointType; empty without messages. InputError if
/// it cannot be read.
std::vector<std::string> JointNames(const std::filesystem::path& bag, const BagTopic& topic,
                                    UnpackedFiles* unpacked);

}  // namespace tera
