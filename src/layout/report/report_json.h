#pragma once

#include <filesystem>
#include <string>

#include "layout/layout_report.h"

namespace tera {

/// Text of layout.json (format: docs/reference/layout.md).
std::string ReportJson(const LayoutReport& report);

/// Reads a layout.json; a folder stands for the layout.json inside. Throws InputError if the file
/// is missing, damaged or of another format.
LayoutReport ReadReport(const std::filesystem::path& file_or_folder);

}  // namespace tera
