#include "app/diagnosed_report.h"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "app/progress/diagnose_progress.h"
#include "core/error.h"
#include "diagnose/report/files/write_report.h"
#include "diagnose/report/text/sentence.h"
#include "diagnose/report/text/summary.h"

namespace tera {
namespace {

/// That none of the further recordings is the one that is searched.
void RequireOthers(const DiagnoseArguments& arguments) {
  for (const std::filesystem::path& further : arguments.task.held_out) {
    std::error_code none;
    if (!std::filesystem::equivalent(further, arguments.recording, none)) continue;
    throw InputError(fmt::format(
        "--held-out {}: is the recording that is searched; need one that nothing is fitted to",
        further.string()));
  }
}

void Print(const Diagnosis& diagnosis) {
  if (const std::string summary = SummaryOf(diagnosis); !summary.empty()) {
    fmt::print("{}\n", summary);
  }
  for (const std::string& sentence : SentencesOf(diagnosis)) fmt::print("{}\n", sentence);
}

}  // namespace

void ReportDiagnosis(DiagnoseArguments arguments) {
  StageClock clock;
  RequireNewFolder(arguments.out);
  RequireOthers(arguments);
  const Scenario scenario = Load(arguments.scenario).scenario;
  const Recording recording(arguments.recording);
  if (arguments.library) arguments.task.library = ReadCandidateLibrary(*arguments.library);
  ReportFolder report(arguments.out);  // one that cannot be written is not worth a search
  DiagnoseProgress bar(&clock);
  const std::vector<Diagnosis> diagnoses = DiagnoseRecording(
      scenario, recording, arguments.task,
      [&](const BlockProgress& progress) { bar.Show(progress); }, &clock);
  for (const Diagnosis& diagnosis : diagnoses) Print(diagnosis);
  for (const std::filesystem::path& page : report.Write(diagnoses, recording)) {
    fmt::print("report: {}\n", page.string());
  }
  if (arguments.profile) fmt::print("{}", clock.Table());
}

}  // namespace tera
