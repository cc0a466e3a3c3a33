#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "dataset/files/whole_folder.h"
#include "diagnose/diagnose_recording.h"
#include "diagnose/recordings/shared_causes.h"

// Result of several recordings of one machine, as a page and files.

namespace tera {

/// "Boom: dead band in recordings 1 and 3, width 0.121 ± 0.003. Recording 2: not there, where one
/// of this size would have shown."
std::string SentenceOf(const SharedCause& cause);

/// "3 recordings: 2 causes that they share and 1 cause that differs from one to another."
std::string AnswerText(const std::vector<SharedCause>& causes, std::size_t recordings);

/// A recording's name and the page of its own report.
struct RecordingOnPage {
  std::string name, page;
  const Diagnosis* diagnosis = nullptr;
};

/// The page of several recordings of one machine: shared causes first, the findings of each
/// recording tested on the others.
std::string RecordingsPage(const std::string& machine,
                           const std::vector<RecordingOnPage>& recordings,
                           const std::vector<SharedCause>& causes);

/// File name of the page on several recordings.
inline constexpr const char* kRecordingsPage = "recordings.html";

/// Writes the reports of several recordings into recording_1, recording_2, ... The common result is
/// in recordings.html, recordings.json and effects.yaml. effects.yaml is the overlay of the shared
/// causes with pooled parameters. With several machines, each machine has its own folder. The
/// folder appears when it is complete. Returns the page of each machine. Throws InputError.
std::vector<std::filesystem::path> WriteRecordingsReport(
    const std::filesystem::path& out, const std::vector<DiagnosedRecording>& recordings,
    WholeFolder* whole);

}  // namespace tera
