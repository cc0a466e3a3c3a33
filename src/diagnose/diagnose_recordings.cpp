#include "diagnose/diagnose_recordings.h"

#include "core/error.h"

namespace tera {
namespace {

/// That all paths are of different folders.
void RequireDifferent(const std::vector<std::filesystem::path>& paths) {
  for (std::size_t i = 0; i < paths.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      std::error_code none;
      if (!std::filesystem::equivalent(paths[i], paths[j], none)) continue;
      throw InputError(paths[i].string(), {FaultKind::kRepeated,
                                           "is named twice; need different recordings, since each "
                                           "is judged by those that it has not seen"});
    }
  }
}

}  // namespace

std::vector<DiagnosedRecording> DiagnoseRecordings(
    const Scenario& scenario, const std::vector<std::filesystem::path>& recordings,
    const DiagnosisTask& task, const FollowProgress& progress, StageClock* clock) {
  RequireDifferent(recordings);
  std::vector<Recording> opened;
  for (const std::filesystem::path& path : recordings) {
    opened.emplace_back(path);
    for (std::size_t r = 0; r + 1 < opened.size(); ++r) RequireOtherTime(opened[r], opened.back());
  }
  std::vector<DiagnosedRecording> diagnosed;
  for (std::size_t r = 0; r < recordings.size(); ++r) {
    DiagnosisTask one = task;
    for (std::size_t other = 0; other < recordings.size(); ++other) {
      if (other != r) one.held_out.push_back(recordings[other]);
    }
    diagnosed.push_back(
        {recordings[r], DiagnoseRecording(scenario, opened[r], one, progress, clock)});
  }
  return diagnosed;
}

std::vector<const Diagnosis*> OfMachine(const std::vector<DiagnosedRecording>& recordings,
                                        std::size_t machine) {
  std::vector<const Diagnosis*> diagnoses;
  for (const DiagnosedRecording& one : recordings) diagnoses.push_back(&one.machines[machine]);
  return diagnoses;
}

}  // namespace tera
