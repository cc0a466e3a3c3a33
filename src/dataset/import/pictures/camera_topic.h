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

struct StampedPicture {
  TimeNs t_ns = 0;
  ImportedPicture picture;
};

/// Reads a sensor_msgs/Image or CompressedImage. The time is the header's stamp, or `log_ns` with
/// `by_log_time`. Throws BadBytes if the message does not fit its type, and InputError as
/// DecodePixels and DecodePictureFile do.
StampedPicture ReadPictureMessage(const BagTopic& topic, const BagMessage& message,
                                  const std::string& place, bool by_log_time);

/// Reason why the first image of a topic cannot be read; empty if it can.
std::string FaultOfFirstPicture(const std::filesystem::path& bag, const BagTopic& topic,
                                UnpackedFiles* unpacked);

/// Lens in the first message of a sensor_msgs/CameraInfo topic.
///
/// Model   The values plumb_bob, rational_polynomial and equidistant of `distortion_model` map to
///         the laws of CameraLens; an empty value means no distortion. With `is_rectified`, as for
///         topics named image_rect, the lens is the matrix P without distortion.
/// Throws  InputError if there is no message, for any other model, and for images that are binned
///         or cropped, because CameraInfo does not describe their lens.
CameraLens ReadCameraInfo(const std::filesystem::path& bag, const BagTopic& topic,
                          UnpackedFiles* unpacked, bool is_rectified);

}  // namespace tera
