#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tera {

/// Turns CSV files into a recording by a YAML mapping: for every channel its file, columns, units,
/// scales, frame and time base (docs/dataset.md, "Importing CSV"). Throws InputError for a mapping
/// or a file that is not as it says, with file:line, and then leaves nothing behind.
/// `overrides` are key.path=value texts as of --set, above all `file=recording.csv`.
void ImportCsv(const std::filesystem::path& mapping, const std::filesystem::path& out,
               const std::vector<std::string>& overrides = {});

}  // namespace tera
