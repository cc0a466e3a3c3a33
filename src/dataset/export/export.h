#pragma once

#include <cstdint>
#include <filesystem>

#include "dataset/export/export_options.h"

/// Exports recordings to other formats; docs/reference/export.md describes each.

namespace tera {

struct ExportReport {
  std::int64_t records = 0, files = 0, bytes = 0;
  std::int64_t messages = 0;  ///< in a bag; a record gives any number of messages
  AbsentPictures absent;      ///< missing pictures that a bag omits
};

/// Writes the recording `dataset` as the new folder `out`. Memory holds one record of each channel,
/// two frames per thread, and the data that the format collects before writing.
///
/// Throws  InputError if the recording cannot be read or has nothing for the format, and if `out`
///         exists or cannot be written. It then leaves nothing behind, except complete frames with
///         `resume` in a format that resumes by frames. Files of a stopped export are refused
///         without `resume`, and with it if they belong to another export.
ExportReport Export(const std::filesystem::path& dataset, const std::filesystem::path& out,
                    const ExportOptions& options);

}  // namespace tera
