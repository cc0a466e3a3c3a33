#pragma once

#include <string>

#include "dataset/ros/names.h"
#include "sensors/sensor.h"
#include "sim/scenario/scenario.h"

/// Names of ROS topics and frames. They begin with the name of the machine.

namespace tera::ros {

/// Name of a ROS topic in DDS, such as "rt/excavator1/odom".
std::string DdsTopicOf(const std::string& ros_topic);

/// Topic of a sensor, relative to its machine. It is the sensor's name, with a leading `gnss`
/// replaced by `gps`, as is usual in ROS.
std::string TopicOf(const SensorDescription& sensor);

/// Throws InputError if the name of a machine, sensor or link is invalid in ROS, or if two objects
/// would have the same topic or frame. A valid name consists of letters, digits and '_' and does
/// not begin with a digit. A link name may consist of several such parts, separated by '/'.
///
/// Source  ROS 2 design article "Topic and service names"; tf2, whose frames begin with no '/'.
void RequireRosNames(const Scenario& scenario);

}  // namespace tera::ros
