#pragma once

#include <filesystem>

#include "dataset/import/import_options.h"

namespace tera {

/// Converts tables, logs and ROS bags to a recording, as described by a YAML mapping. For each
/// channel the mapping gives file, columns or topic, units, scales, frame and time base
/// (docs/reference/dataset.md, "Importing CSV" and "Importing ROS logs"). Throws InputError with
/// file and line if the mapping or a file is unsuitable; no files are left then.
ImportReport ImportCsv(const std::filesystem::path& mapping, const std::filesystem::path& out,
                       const ImportOptions& options = {});

}  // namespace tera
