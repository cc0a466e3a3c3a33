#include "dataset/ros/delta_can.h"

#include <algorithm>

#include "core/check.h"

namespace tera::ros {

float DeltaCan::*FieldOfLever(std::string_view name, bool drives_gear) {
  if (drives_gear) {
    if (name.starts_with("left")) return &DeltaCan::left_travel;
    if (name.starts_with("right")) return &DeltaCan::right_travel;
    return nullptr;
  }
  for (const DeltaCanField& field : kDeltaCanFields) {
    if (name == field.name) return field.value;
  }
  return nullptr;
}

DeltaCan DeltaCanOf(const std::vector<NamedLever>& levers, const std::vector<double>& positions,
                    TimeNs stamp_ns) {
  TERA_CHECK(positions.size() == levers.size(), "a position for each lever");
  const TimeNs known_ns = std::max<TimeNs>(0, stamp_ns);
  DeltaCan message{.stamp_sec = static_cast<std::int32_t>(known_ns / kNsPerSecond),
                   .stamp_nanosec = static_cast<std::uint32_t>(known_ns % kNsPerSecond),
                   .enable = true,
                   .high_speed = true};
  for (std::size_t l = 0; l < levers.size(); ++l) {
    const auto position = static_cast<float>(positions[l]);
    if (float DeltaCan::*const field = FieldOfLever(levers[l].name, levers[l].drives_gear)) {
      message.*field = position;
    } else {
      message.others.push_back(position);
    }
  }
  return message;
}

}  // namespace tera::ros
