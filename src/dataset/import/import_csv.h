#pragma once

#include <filesystem>

#include "dataset/import/import_options.h"

namespace tera {

/// Converts text tables and bags of ROS messages to a recording by a YAML mapping. For every
/// channel the mapping gives file, columns or topic, units, scales, frame and time base
/// (docs/reference/dataset.md, "Importing CSV" and "Importing ROS logs"). Throws InputError with
/// file:line for a mapping or file that does not fit, and then leaves nothing behind.
ImportReport ImportCsv(const std::filesystem::path& mapping, const std::filesystem::path& out,
                       const ImportOptions& options = {});

}  // namespace tera
