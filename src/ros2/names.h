#pragma once

#include <string>

#include "dataset/ros/names.h"
#include "sensors/sensor.h"
#include "sim/scenario/scenario.h"

/// ROS names: topics and frames below the machine's name.

namespace tera::ros {

/// DDS topic name of a ROS topic: "rt/excavator1/odom".
std::string DdsTopicOf(const std::string& ros_topic);

/// Topic prefix of a sensor below its machine: its name, with a leading `gnss` replaced by ROS's
/// usual `gps`.
std::string TopicOf(const SensorDescription& sensor);

/// Throws InputError if a machine, sensor or link name is invalid in ROS, or if two objects would
/// share a topic or a frame. ROS allows letters, digits and '_', without a leading digit; link
/// names may have several such parts separated by '/'.
///
/// Source  ROS 2 design article "Topic and service names"; tf2, whose frames begin with no '/'.
void RequireRosNames(const Scenario& scenario);

}  // namespace tera::ros
