#pragma once

#include <cstdint>
#include <filesystem>

#include "dataset/export/export_options.h"

/// Exports recordings to other formats, which docs/reference/export.md describes.

namespace tera {

struct ExportReport {
  std::int64_t records = 0, files = 0, bytes = 0;
  std::int64_t messages = 0;  ///< messages in a bag; a record may give none or several
  AbsentPictures absent;      ///< images that the recording lists but lacks; a bag omits them
};

/// Converts the recording `dataset` to the new folder `out`. Memory holds one record per channel,
/// two frames per thread, and data that a format must collect before it is written.
///
/// Throws  InputError if the recording cannot be read or has no data for the format, or if `out`
///         exists or cannot be written. No files are left, except complete frames if `resume` is
///         set and the format can resume. Files of a stopped export cause an InputError without
///         `resume`, and with it if they belong to a different export.
ExportReport Export(const std::filesystem::path& dataset, const std::filesystem::path& out,
                    const ExportOptions& options);

}  // namespace tera
