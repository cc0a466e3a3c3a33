#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/types/measurement.h"

namespace tera {

/// The labelled objects of one image as JSON text (boxes/<t_ns>.json; see
/// docs/reference/dataset.md), with its exposure and loads if it has them.
std::string EncodeBoxes(const CameraFrame& frame);

/// Reads such a file back into the frame. Throws InputError with the file and the missing item.
void ReadBoxes(const std::filesystem::path& file, CameraFrame* frame);
/// Reads only the objects.
std::vector<ObjectBox> ReadBoxes(const std::filesystem::path& file);

}  // namespace tera
