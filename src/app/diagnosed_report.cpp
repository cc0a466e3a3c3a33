#include "app/diagnosed_report.h"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "app/progress/diagnose_progress.h"
#include "core/error.h"
#include "diagnose/report/files/recordings_report.h"
#include "diagnose/report/files/write_report.h"
#include "diagnose/report/text/sentences.h"

namespace tera {
namespace {

/// Throws InputError if a recording is used both for the search and as held-out data.
void RequireOthers(const DiagnoseArguments& arguments) {
  for (const std::filesystem::path& further : arguments.task.held_out) {
    for (const std::filesystem::path& searched : arguments.recordings) {
      std::error_code none;
      if (!std::filesystem::equivalent(further, searched, none)) continue;
      throw InputError("--held-out " + further.string(),
                       {FaultKind::kRepeated,
                        "is the searched recording; need a recording without fitted parameters"});
    }
  }
}

void Print(const Diagnosis& diagnosis) {
  if (const std::string summary = SummaryOf(diagnosis); !summary.empty()) {
    fmt::print("{}\n", summary);
  }
  for (const std::string& sentence : SentencesOf(diagnosis)) fmt::print("{}\n", sentence);
}

void PrintPages(const std::vector<std::filesystem::path>& pages) {
  for (const std::filesystem::path& page : pages) fmt::print("report: {}\n", page.string());
}

void ReportOne(const Scenario& scenario, const DiagnoseArguments& arguments, StageClock* clock) {
  const Recording recording(arguments.recordings.front());
  ReportFolder report(arguments.out);  // before the search, so that an unwritable folder is
                                       // reported at once
  DiagnoseProgress bar(clock);
  const std::vector<Diagnosis> diagnoses = DiagnoseRecording(
      scenario, recording, arguments.task,
      [&](const BlockProgress& progress) { bar.Show(progress); }, clock);
  for (const Diagnosis& diagnosis : diagnoses) Print(diagnosis);
  PrintPages(report.Write(diagnoses, recording));
}

void PrintTogether(const std::vector<DiagnosedRecording>& recordings) {
  for (std::size_t m = 0; m < recordings.front().machines.size(); ++m) {
    const std::vector<SharedCause> causes = SharedCausesOf(OfMachine(recordings, m));
    fmt::print("{}: {}\n", recordings.front().machines[m].scenario,
               AnswerText(causes, recordings.size()));
    for (const SharedCause& cause : causes) fmt::print("{}\n", SentenceOf(cause));
  }
}

void ReportSeveral(const Scenario& scenario, const DiagnoseArguments& arguments,
                   StageClock* clock) {
  WholeFolder whole(arguments.out);
  DiagnoseProgress bar(clock);
  const std::vector<DiagnosedRecording> recordings = DiagnoseRecordings(
      scenario, arguments.recordings, arguments.task,
      [&](const BlockProgress& progress) { bar.Show(progress); }, clock);
  PrintTogether(recordings);
  PrintPages(WriteRecordingsReport(arguments.out, recordings, &whole));
}

}  // namespace

void ReportDiagnosis(DiagnoseArguments arguments) {
  StageClock clock;
  RequireNewFolder(arguments.out);
  RequireOthers(arguments);
  const Scenario scenario = Load(arguments.scenario).scenario;
  if (arguments.library) arguments.task.library = ReadCandidateLibrary(*arguments.library);
  (arguments.recordings.size() == 1 ? ReportOne : ReportSeveral)(scenario, arguments, &clock);
  if (arguments.profile) fmt::print("{}", clock.Table());
}

}  // namespace tera
