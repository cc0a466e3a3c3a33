#pragma once

#include <filesystem>

#include "dataset/import/import_options.h"

namespace tera {

/// Turns text tables and bags of ROS messages into a recording by a YAML mapping: for every channel
/// its file, columns or topic, units, scales, frame and time base (docs/reference/dataset.md,
/// "Importing CSV" and "Importing ROS logs"). Throws InputError for a mapping or a file that is not
/// as it says, with file:line, and then leaves nothing behind.
ImportReport ImportCsv(const std::filesystem::path& mapping, const std::filesystem::path& out,
                       const ImportOptions& options = {});

}  // namespace tera
