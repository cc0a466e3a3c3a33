#pragma once

#include <filesystem>
#include <string>

namespace tera {

/// Reads a number from a JSON report.
///
/// Model   `figure` is a path of keys, such as "summary.rmse_m". `[2]` selects an item of a list by
///         index. `[zone/around/seen_by_1]` selects the item that has this text as one of its
///         values, such as its name.
/// Throws  InputError at `place` if the path does not lead to a number. The message lists the keys,
///         indices or names that exist.
double ReportFigure(const std::filesystem::path& report, const std::string& figure,
                    const std::string& place);

}  // namespace tera
