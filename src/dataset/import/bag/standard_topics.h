#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dataset/import/bag/bag_source.h"

/// Standard assignment of message fields to columns of a channel. It covers standard ROS messages
/// and the log formats of foreign_log.h, so a mapping need not list these columns.

namespace tera {

struct StandardColumn {
  std::string path;
  double factor = 1.0;    ///< SI units per unit of the field
  bool may_lack = false;  ///< the value may be absent, such as a position without a fix
};

/// The field that fills the column `key`, such as "wx" or "lat". Returns nullopt if the type does
/// not fill a channel of that key on its own. Supported types are sensor_msgs/Imu,
/// sensor_msgs/NavSatFix, nav_msgs/Odometry, geometry_msgs/PoseStamped,
/// geometry_msgs/PoseWithCovarianceStamped, geometry_msgs/TransformStamped, the types of
/// foreign_log.h, and one transform of a list of transforms.
std::optional<StandardColumn> StandardColumnOf(std::string_view type, std::string_view key);

inline constexpr std::string_view kImuType = "sensor_msgs/Imu";
inline constexpr std::string_view kFixType = "sensor_msgs/NavSatFix";
inline constexpr std::string_view kJointType = "sensor_msgs/JointState";
/// Field of kFixType that is nonzero if the covariance is known.
inline constexpr const char* kCovarianceTypePath = "position_covariance_type";

/// True for message types that are lists of transforms: tf2_msgs/TFMessage and tf/tfMessage.
bool HoldsTransforms(std::string_view type);
/// Path prefix of a transform in such a list: "transforms[odom>base_link]."
std::string PathOfTransform(const std::string& parent, const std::string& child);

/// Counts the messages of a topic by the names that they contain: the list of joints, or each
/// transform as "odom>base_link". Unreadable messages are skipped.
std::map<std::vector<std::string>, std::int64_t> NamesInMessages(const std::filesystem::path& bag,
                                                                 const BagTopic& topic,
                                                                 UnpackedFiles* unpacked);

/// Joint names in the first message of a topic of kJointType; empty if there is no message. Throws
/// InputError if the message cannot be read.
std::vector<std::string> JointNames(const std::filesystem::path& bag, const BagTopic& topic,
                                    UnpackedFiles* unpacked);

}  // namespace tera
