#include "dataset/ros/names.h"

#include "dataset/format/channel.h"

namespace tera::ros {

std::string TopicOf(const std::string& machine, const std::string& topic) {
  return "/" + machine + "/" + topic;
}

std::string FrameOf(const std::string& machine, const std::string& part) {
  return machine + "/" + part;
}

std::string OpticalFrameOf(const std::string& machine, const std::string& camera) {
  return FrameOf(machine, camera + kOpticalEnding);
}

std::string SensorTopicOf(const std::string& sensor, std::string_view type) {
  const std::string gnss = "gnss";
  if (type != kGnssChannel || !sensor.starts_with(gnss)) return sensor;
  return "gps" + sensor.substr(gnss.size());
}

std::string LabelTopic(const LabelChannel& channel) {
  return std::string(channel.name) + "/image_raw";
}

}  // namespace tera::ros
