#include "dataset/ros/names.h"

#include <cctype>

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

std::string AllowedName(std::string_view name) {
  std::string taken;
  for (const char c : name) {
    const bool begins = taken.empty() || taken.back() == '/';
    const bool digit = std::isdigit(static_cast<unsigned char>(c)) != 0;
    const bool letter = std::isalpha(static_cast<unsigned char>(c)) != 0;
    if (digit && begins) taken += '_';
    taken += digit || letter || c == '/' ? c : '_';
  }
  return taken;
}

}  // namespace tera::ros
