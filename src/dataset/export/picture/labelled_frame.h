#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/types/measurement.h"
#include "dataset/export/export_job.h"

namespace tera {

/// Labels of one camera image, without colour and depth.
struct LabelledFrame {
  TimeNs t_ns = 0;
  Image<std::uint8_t> semantic;   ///< SemanticClass
  Image<std::uint16_t> instance;  ///< 0: none
  std::vector<ObjectBox> boxes;   ///< empty if not recorded
};

bool IsThere(const std::filesystem::path& file);

/// Path "camera/kind/<t_ns>.png", or .json for boxes.
std::filesystem::path FrameFile(const Recording& recording, const std::string& camera,
                                std::string_view kind, TimeNs t_ns);

/// Cameras whose first frame has an image of every kind, in the order of dataset.yaml.
std::vector<std::string> CamerasWith(const Recording& recording,
                                     const std::vector<std::string_view>& kinds);

/// Throws InputError if an image is missing or truncated, if image sizes differ, or if a class is
/// unknown.
LabelledFrame LoadLabels(const Recording& recording, const std::string& camera, TimeNs t_ns);

struct PictureSize {
  int width_px = 0, height_px = 0;
};
/// Image size from the header of a PNG. Throws InputError if the file is not a PNG.
PictureSize SizeOfPng(const std::filesystem::path& file);

/// Content of a PNG file. Throws InputError if it cannot be read or is truncated.
std::string ReadWholePng(const std::filesystem::path& file);

}  // namespace tera
