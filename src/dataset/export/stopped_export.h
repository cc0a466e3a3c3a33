#pragma once

#include <filesystem>
#include <string>

#include "dataset/export/export_options.h"
#include "dataset/format/recording.h"

namespace tera {

class WholeFolder;

/// What tells one export from another, a line for each: version of the program, options, digest of
/// dataset.yaml and length of each channel's table. It tells other recordings and other options; a
/// table that was changed to one of the same length, and changed pictures, it does not.
std::string ExportKey(const Recording& recording, const ExportOptions& options);

/// Makes ready the folder of an export that a stopped one may have begun: it then holds
/// INCOMPLETE.export with the key. Of a format that goes on with whole frames, what is whole stays;
/// of any other, nothing does. Throws InputError, and leaves all as it is, where the folder holds
/// something of another export or of no export.
void BeginExport(const std::string& key, ExportFormat format, WholeFolder* folder);

/// Takes INCOMPLETE.export out of a folder that is finished.
void EndExport(const std::filesystem::path& folder);

/// Refuses a place beside which a stopped export lies, and says how it is gone on with.
void RequireNoStoppedExport(const std::filesystem::path& out);

}  // namespace tera
