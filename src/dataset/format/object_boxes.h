#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/types/measurement.h"

namespace tera {

/// The labelled objects of one image as JSON text (boxes/<t_ns>.json; see
/// docs/reference/dataset.md).
std::string EncodeBoxes(TimeNs t_ns, const std::vector<ObjectBox>& boxes);

/// Reads such a file back. Throws InputError naming the file and what is missing.
std::vector<ObjectBox> ReadBoxes(const std::filesystem::path& file);

}  // namespace tera
