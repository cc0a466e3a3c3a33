#pragma once

#include <filesystem>
#include <vector>

#include "dataset/files/whole_folder.h"
#include "diagnose/diagnose_recordings.h"
#include "diagnose/recordings/shared_causes.h"

namespace tera {

/// The name of the page of several recordings.
inline constexpr const char* kRecordingsPage = "recordings.html";

/// Writes the reports of several recordings into recording_1, recording_2, ... Their joint result
/// goes to recordings.html, recordings.json and effects.yaml, the overlay of the shared causes with
/// pooled parameters. Several machines have a folder each. The folder appears when it is complete.
/// Returns the page of each machine. Throws InputError.
std::vector<std::filesystem::path> WriteRecordingsReport(
    const std::filesystem::path& out, const std::vector<DiagnosedRecording>& recordings,
    WholeFolder* whole);

}  // namespace tera
