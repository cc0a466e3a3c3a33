#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "dataset/format/sensor_sheet.h"
#include "dataset/import/bag/bag_source.h"
#include "dataset/import/pictures/picture_bytes.h"

namespace tera {

inline constexpr std::string_view kImageType = "sensor_msgs/Image",
                                  kCompressedImageType = "sensor_msgs/CompressedImage",
                                  kCameraInfoType = "sensor_msgs/CameraInfo";

/// A picture with its time.
struct StampedPicture {
  TimeNs t_ns = 0;
  ImportedPicture picture;
};

/// The picture of one sensor_msgs/Image or CompressedImage. Its stamp is the header's, or `log_ns`
/// with `by_log_time`. Throws BadBytes where the message violates its type, and InputError as
/// DecodePixels and DecodePictureFile do.
StampedPicture ReadPictureMessage(const BagTopic& topic, const BagMessage& message,
                                  const std::string& place, bool by_log_time);

/// Why the first picture of a topic cannot be read; empty if it can.
std::string FaultOfFirstPicture(const std::filesystem::path& bag, const BagTopic& topic,
                                UnpackedFiles* unpacked);

/// The lens of the first message of a sensor_msgs/CameraInfo topic.
///
/// Model   `distortion_model` plumb_bob, rational_polynomial and equidistant as the laws of
///         CameraLens; none is no distortion. With `is_rectified` the lens is P, without
///         distortion, as pictures of topics image_rect have it.
/// Throws  InputError without a message, for another model, and for pictures that are binned or
///         cut, whose lens the message does not state.
CameraLens ReadCameraInfo(const std::filesystem::path& bag, const BagTopic& topic,
                          UnpackedFiles* unpacked, bool is_rectified);

}  // namespace tera
