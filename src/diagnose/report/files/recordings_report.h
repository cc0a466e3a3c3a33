#pragma once

#include <filesystem>
#include <vector>

#include "dataset/files/whole_folder.h"
#include "diagnose/diagnose_recordings.h"
#include "diagnose/recordings/shared_causes.h"

namespace tera {

/// The name of the page of several recordings.
inline constexpr const char* kRecordingsPage = "recordings.html";

/// Writes the report of each of several recordings into recording_1, recording_2, ..., and of what
/// they say together recordings.html, recordings.json and effects.yaml, the overlay of the causes
/// that they share, with numbers over all of them; in a folder of each machine where there are
/// several. The folder appears when it is complete. Returns the page of each machine. Throws
/// InputError.
std::vector<std::filesystem::path> WriteRecordingsReport(
    const std::filesystem::path& out, const std::vector<DiagnosedRecording>& recordings,
    WholeFolder* whole);

}  // namespace tera
