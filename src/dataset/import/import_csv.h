#pragma once

#include <filesystem>

#include "dataset/import/import_options.h"

namespace tera {

/// Turns text tables into a recording by a YAML mapping: for every channel its file, columns,
/// units, scales, frame and time base (docs/reference/dataset.md, "Importing CSV"). Throws
/// InputError for a mapping or a file that is not as it says, with file:line, and then leaves
/// nothing behind.
ImportReport ImportCsv(const std::filesystem::path& mapping, const std::filesystem::path& out,
                       const ImportOptions& options = {});

}  // namespace tera
