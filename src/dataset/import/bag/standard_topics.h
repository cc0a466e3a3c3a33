#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dataset/import/bag/bag_source.h"

/// Which fields of ROS's standard messages, and of logs of known form, are which columns of a
/// channel, so that a mapping need not say so.

namespace tera {

struct StandardColumn {
  std::string path;
  double factor = 1.0;    ///< SI units in one of the field's
  bool may_lack = false;  ///< as the position of a receiver without a fix
};

/// The field of a type that the mapping's key, "wx" or "lat", means. None where the type is not one
/// of those that a channel of that key is made of by itself:
/// sensor_msgs/Imu, sensor_msgs/NavSatFix, nav_msgs/Odometry, geometry_msgs/PoseStamped,
/// geometry_msgs/PoseWithCovarianceStamped, geometry_msgs/TransformStamped, the types of
/// foreign_log.h, and of the messages of many transforms the fields of one of these.
std::optional<StandardColumn> StandardColumnOf(std::string_view type, std::string_view key);

inline constexpr std::string_view kImuType = "sensor_msgs/Imu";
inline constexpr std::string_view kFixType = "sensor_msgs/NavSatFix";
inline constexpr std::string_view kJointType = "sensor_msgs/JointState";
/// Field of kFixType: whether the covariance is known, nonzero if so.
inline constexpr const char* kCovarianceTypePath = "position_covariance_type";

/// Whether the messages of a type are lists of transforms: tf2_msgs/TFMessage, tf/tfMessage.
bool HoldsTransforms(std::string_view type);
/// The path of one of them, "transforms[odom>base_link]."
std::string PathOfTransform(const std::string& parent, const std::string& child);

/// Counts the messages of a topic by the names in them: the joints of each, or each of the
/// transforms as "odom>base_link". Messages that cannot be read are passed over.
std::map<std::vector<std::string>, std::int64_t> NamesInMessages(const std::filesystem::path& bag,
                                                                 const BagTopic& topic,
                                                                 UnpackedFiles* unpacked);

/// The joints that the first message of a topic of kJointType names; none where there is no
/// message. InputError where it cannot be read.
std::vector<std::string> JointNames(const std::filesystem::path& bag, const BagTopic& topic,
                                    UnpackedFiles* unpacked);

}  // namespace tera
