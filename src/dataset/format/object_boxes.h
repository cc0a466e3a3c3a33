#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/types/measurement.h"

namespace tera {

/// The labelled objects of one image as JSON text (boxes/<t_ns>.json; see
/// docs/reference/dataset.md), with its exposure and its loads where the frame has them.
std::string EncodeBoxes(const CameraFrame& frame);

/// Reads such a file back into the frame. Throws InputError naming the file and what is missing.
void ReadBoxes(const std::filesystem::path& file, CameraFrame* frame);
/// The objects alone.
std::vector<ObjectBox> ReadBoxes(const std::filesystem::path& file);

}  // namespace tera
