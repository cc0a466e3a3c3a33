#pragma once

#include <filesystem>

#include "layout/layout_report.h"

namespace tera {

/// Writes a report into `folder`: layout.json, figures.csv (mean, worst, errors), moments.csv (each
/// moment), blind.csv (causes), maps/*.png and report.html, which loads nothing from the network.
///
/// Throws  InputError if a file cannot be written.
void WriteReport(const LayoutReport& report, const std::filesystem::path& folder);

std::string ReportPage(const LayoutReport& report);

}  // namespace tera
