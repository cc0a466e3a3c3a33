#pragma once

#include "dataset/export/bag/bag_writer.h"

/// What docs/reference/ros2.md offers topics with.

namespace tera {

inline constexpr TopicQuality kSensorData = {5, false, false};
inline constexpr TopicQuality kLarge = {2, true, false};
inline constexpr TopicQuality kState = {10, true, false};
inline constexpr TopicQuality kManyTransforms = {100, true, false};
inline constexpr TopicQuality kLatched = {1, true, true};
inline constexpr TopicQuality kLatest = {1, false, false};

}  // namespace tera
