#pragma once

#include <filesystem>
#include <string>

#include "layout/layout_report.h"

namespace tera {

/// The report as layout.json has it (docs/reference/layout.md).
std::string ReportJson(const LayoutReport& report);

/// Reads a layout.json, or that of a folder. Throws InputError where it is missing, damaged, or of
/// another format.
LayoutReport ReadReport(const std::filesystem::path& file_or_folder);

}  // namespace tera
