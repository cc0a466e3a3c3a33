#include "ros2/names.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "core/error.h"

namespace tera::ros {
namespace {

bool IsLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

bool IsRosName(const std::string& name) {
  return !name.empty() && IsLetter(name.front()) &&
         std::all_of(name.begin(), name.end(),
                     [](char c) { return IsLetter(c) || (c >= '0' && c <= '9'); });
}

void RequireRosName(const std::string& kind, const std::string& name) {
  if (IsRosName(name)) return;
  throw InputError(
      "",
      {FaultKind::kMalformed,
       fmt::format("{} '{}' cannot name a ROS topic; need letters, digits and '_', no digit first: "
                   "rename it in the scenario or its rig",
                   kind, name)});
}

/// The name of a link is the last part of a frame name, and may itself consist of several parts.
void RequireFrameName(const ScenarioMachine& machine, const std::string& link) {
  bool names = true;
  for (std::size_t begin = 0; names && begin <= link.size();) {
    const std::size_t end = std::min(link.find('/', begin), link.size());
    names = IsRosName(link.substr(begin, end - begin));
    begin = end + 1;
  }
  if (names) return;
  throw InputError(
      "", {FaultKind::kMalformed,
           fmt::format(
               "link '{}' of machine '{}' cannot name a ROS frame; need letters, digits and '_', "
               "no digit first, or several such names with '/' between: rename it in the "
               "machine's file or its URDF",
               link, machine.placement.name)});
}

void RequireDistinct(const ScenarioMachine& machine) {
  std::set<std::string> frames;
  std::set<std::string> topics = {"odom",    "joint_states", "cylinders",
                                  "ee_pose", "bucket_mass",  "delta_can"};
  for (const Link& link : machine.placement.model.links) frames.insert(link.name);
  for (const SensorDescription& sensor : machine.sensors) {
    const bool camera = KindOf(sensor).form == ChannelForm::kPictures;
    if ((!sensor.link.empty() && !frames.insert(sensor.name).second) ||
        (camera && !frames.insert(sensor.name + kOpticalEnding).second)) {
      throw InputError(
          "", {FaultKind::kRepeated,
               fmt::format("sensor '{}' of machine '{}' and a link or sensor of that name would be "
                           "one frame; need another name for the sensor",
                           sensor.name, machine.placement.name)});
    }
    if (!topics.insert(TopicOf(sensor)).second) {
      throw InputError(
          "", {FaultKind::kRepeated,
               fmt::format(
                   "sensor '{}' of machine '{}' would publish at '{}', which is taken by another "
                   "sensor or by the machine itself; need another name for the sensor",
                   sensor.name, machine.placement.name, TopicOf(sensor))});
    }
  }
}

}  // namespace

std::string DdsTopicOf(const std::string& ros_topic) { return "rt" + ros_topic; }

std::string TopicOf(const SensorDescription& sensor) {
  return SensorTopicOf(sensor.name, TypeOf(sensor));
}

void RequireRosNames(const Scenario& scenario) {
  for (const ScenarioMachine& machine : scenario.machines) {
    RequireRosName("machine", machine.placement.name);
    for (const SensorDescription& sensor : machine.sensors) RequireRosName("sensor", sensor.name);
    for (const Link& link : machine.placement.model.links) RequireFrameName(machine, link.name);
    RequireDistinct(machine);
  }
}

}  // namespace tera::ros
