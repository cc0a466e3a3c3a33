#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/types/measurement.h"

namespace tera {

/// JSON of the labelled objects in one image, boxes/<t_ns>.json (docs/reference/dataset.md). It
/// includes exposure and loads if the frame has them.
std::string EncodeBoxes(const CameraFrame& frame);

/// Reads such a file into the frame. Throws InputError with the file and the missing item.
void ReadBoxes(const std::filesystem::path& file, CameraFrame* frame);
/// Reads the objects only.
std::vector<ObjectBox> ReadBoxes(const std::filesystem::path& file);

}  // namespace tera
