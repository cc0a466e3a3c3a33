#pragma once

#include <filesystem>
#include <string>

#include "dataset/export/export_options.h"
#include "dataset/format/recording.h"

namespace tera {

class WholeFolder;

/// Text that identifies an export, with one property per line: program version, options, digest of
/// dataset.yaml, and the length of each channel's table. It detects other recordings and options.
/// It does not detect changed images, or table changes that keep the length.
std::string ExportKey(const Recording& recording, const ExportOptions& options);

/// Prepares the output folder and writes INCOMPLETE.export with the key. If a stopped export left
/// files, a format that can resume keeps complete frames; other formats delete everything. Throws
/// InputError, without changing anything, if the files belong to another export or to no export.
void BeginExport(const std::string& key, ExportFormat format, WholeFolder* folder);

/// Deletes INCOMPLETE.export from the complete folder.
void EndExport(const std::filesystem::path& folder);

/// Throws InputError if a stopped export left files for `out`. The message tells the user to
/// resume.
void RequireNoStoppedExport(const std::filesystem::path& out);

}  // namespace tera
