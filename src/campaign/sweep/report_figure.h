#pragma once

#include <filesystem>
#include <string>

namespace tera {

/// A number of a JSON report.
///
/// Model   `figure` is a path of keys, "summary.rmse_m"; `[2]` is an item of a list by its index,
///         `[zone/around/seen_by_1]` the item that has that text as one of its values (its name).
/// Throws  InputError, at `place`, if the path leads to no number; with the keys, indices or names
///         that there are instead.
double ReportFigure(const std::filesystem::path& report, const std::string& figure,
                    const std::string& place);

}  // namespace tera
