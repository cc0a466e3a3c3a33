#pragma once

#include <filesystem>
#include <string>

#include "layout/layout_report.h"

namespace tera {

/// Text of layout.json (docs/reference/layout.md).
std::string ReportJson(const LayoutReport& report);

/// Reads a layout.json, or the one in a folder. Throws InputError if it is missing, damaged, or of
/// another format.
LayoutReport ReadReport(const std::filesystem::path& file_or_folder);

}  // namespace tera
