#pragma once

#include <filesystem>

namespace tera {

/// Turns CSV files into a recording by a YAML mapping: for every channel its file, columns, units,
/// scales, frame and time base (docs/dataset.md, "Importing CSV"). Throws InputError for a mapping
/// or a file that is not as it says, with file:line.
void ImportCsv(const std::filesystem::path& mapping, const std::filesystem::path& out);

}  // namespace tera
