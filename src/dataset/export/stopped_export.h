#pragma once

#include <filesystem>
#include <string>

#include "dataset/export/export_options.h"
#include "dataset/format/recording.h"

namespace tera {

class WholeFolder;

/// Identifies an export, one property per line: version of the program, options, digest of
/// dataset.yaml and length of each channel's table. It detects other recordings and other options,
/// but not changed pictures, or tables changed without a change of length.
std::string ExportKey(const Recording& recording, const ExportOptions& options);

/// Prepares the folder of an export, which a stopped export may have begun, and writes
/// INCOMPLETE.export with the key. A format that resumes by frames keeps complete files; other
/// formats keep none. Throws InputError, and changes nothing, if the folder belongs to another
/// export or to none.
void BeginExport(const std::string& key, ExportFormat format, WholeFolder* folder);

/// Removes INCOMPLETE.export from a finished folder.
void EndExport(const std::filesystem::path& folder);

/// Refuses a place with a stopped export next to it, and says how to resume it.
void RequireNoStoppedExport(const std::filesystem::path& out);

}  // namespace tera
