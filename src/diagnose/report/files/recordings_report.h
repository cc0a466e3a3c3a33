#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "dataset/files/whole_folder.h"
#include "diagnose/diagnose_recording.h"
#include "diagnose/recordings/shared_causes.h"

// Joint result of several recordings of one machine, in words.

namespace tera {

/// "Boom: dead band in recordings 1 and 3, width 0.121 ± 0.003. Recording 2: not there, where one
/// of this size would have shown."
std::string SentenceOf(const SharedCause& cause);

/// "3 recordings: 2 causes that they share and 1 cause that differs from one to another."
std::string AnswerText(const std::vector<SharedCause>& causes, std::size_t recordings);

/// One recording on the page of several: its name and the page of its own report.
struct RecordingOnPage {
  std::string name, page;
  const Diagnosis* diagnosis = nullptr;
};

/// The page of several recordings of one machine: shared causes first, the findings of each
/// recording tested on the others.
std::string RecordingsPage(const std::string& machine,
                           const std::vector<RecordingOnPage>& recordings,
                           const std::vector<SharedCause>& causes);

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
