#pragma once

#include <string>

#include "dataset/ros/names.h"
#include "sensors/sensor.h"
#include "sim/scenario/scenario.h"

/// What things are called in ROS: topics below the machine's name, frames likewise.

namespace tera::ros {

/// The name that the DDS topic behind a ROS topic has: "rt/excavator1/odom".
std::string DdsTopicOf(const std::string& ros_topic);

/// Where a sensor's topics stand below its machine: its own name, but that `gnss` at its beginning
/// becomes `gps`, the name that ROS users look for.
std::string TopicOf(const SensorDescription& sensor);

/// Throws InputError where the name of a machine, a sensor or a link is none in ROS, which allows
/// letters, digits and '_', no digit first, for links several of these with '/' between, or where
/// two things would share a topic or a frame.
///
/// Source  ROS 2 design article "Topic and service names"; tf2, whose frames begin with no '/'.
void RequireRosNames(const Scenario& scenario);

}  // namespace tera::ros
