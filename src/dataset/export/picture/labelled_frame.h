#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/types/measurement.h"
#include "dataset/export/export_job.h"

namespace tera {

/// The labels of a camera's picture, without colour and depth.
struct LabelledFrame {
  TimeNs t_ns = 0;
  Image<std::uint8_t> semantic;   ///< SemanticClass
  Image<std::uint16_t> instance;  ///< 0: none
  std::vector<ObjectBox> boxes;   ///< empty if none were recorded
};

bool IsThere(const std::filesystem::path& file);

/// "camera/kind/<t_ns>.png"; boxes end in .json.
std::filesystem::path FrameFile(const Recording& recording, const std::string& camera,
                                std::string_view kind, TimeNs t_ns);

/// The cameras whose first frame has a picture of each kind, in order of dataset.yaml.
std::vector<std::string> CamerasWith(const Recording& recording,
                                     const std::vector<std::string_view>& kinds);

/// Throws InputError if a picture is missing or incomplete, if the sizes differ, or for an unknown
/// class.
LabelledFrame LoadLabels(const Recording& recording, const std::string& camera, TimeNs t_ns);

struct PictureSize {
  int width_px = 0, height_px = 0;
};
/// Read from the PNG's header. Throws InputError if it is not a PNG.
PictureSize SizeOfPng(const std::filesystem::path& file);

/// The bytes of a PNG file. Throws InputError if it cannot be read or is truncated.
std::string ReadWholePng(const std::filesystem::path& file);

}  // namespace tera
