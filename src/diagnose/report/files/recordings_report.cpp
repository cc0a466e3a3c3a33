#include "diagnose/report/files/recordings_report.h"

#include <fmt/format.h>

#include "dataset/files/checked_file.h"
#include "diagnose/blocks/measured_poses.h"
#include "diagnose/report/files/effects_yaml.h"
#include "diagnose/report/files/recordings_json.h"
#include "diagnose/report/files/write_report.h"
#include "diagnose/report/page/recordings_page.h"

namespace tera {
namespace {

/// A cause as a finding whose numbers are those over all recordings; none where no recording has
/// its numbers.
std::optional<Finding> PooledFinding(const SharedCause& cause) {
  for (const CauseInRecording& one : cause.recordings) {
    if (one.kind != CauseInRecording::Kind::kNamed) continue;
    Finding finding = *one.finding;
    for (const SharedNumber& number : cause.numbers) {
      for (std::size_t i = 0; i < finding.parameters.size(); ++i) {
        if (finding.parameters[i].name != number.name) continue;
        finding.parameters[i].value = finding.term.values[i] = number.pooled.value;
        finding.parameters[i].sigma = number.pooled.sigma;
      }
    }
    finding.evidence.rivals = cause.rivals;
    return finding;
  }
  return std::nullopt;
}

std::string OverlayOf(const std::string& scenario, const std::vector<SharedCause>& causes,
                      std::size_t recordings) {
  std::vector<Finding> pooled;
  for (const SharedCause& cause : causes) {
    std::optional<Finding> finding = PooledFinding(cause);
    if (cause.IsShared() && finding && cause.target() != kPoses) pooled.push_back(*finding);
  }
  std::vector<const Finding*> findings;
  for (const Finding& finding : pooled) findings.push_back(&finding);
  return EffectsYaml(
      scenario, findings,
      fmt::format("What {} recordings share of {} beyond its simulation.", recordings, scenario));
}

void WriteTogether(const std::filesystem::path& directory,
                   const std::vector<DiagnosedRecording>& recordings, std::size_t machine) {
  MakeWritableFolder(directory);
  const std::vector<const Diagnosis*> diagnoses = OfMachine(recordings, machine);
  const std::vector<SharedCause> causes = SharedCausesOf(diagnoses);
  std::vector<std::string> names;
  std::vector<RecordingOnPage> on_page;
  for (std::size_t r = 0; r < recordings.size(); ++r) {
    names.push_back(recordings[r].directory.string());
    on_page.push_back({names.back(), fmt::format("recording_{}/report.html", r + 1), diagnoses[r]});
    WriteReport(directory / fmt::format("recording_{}", r + 1), *diagnoses[r], names.back());
  }
  WriteWholeFile(directory / "recordings.json", RecordingsJson(names, causes));
  WriteWholeFile(directory / "effects.yaml",
                 OverlayOf(diagnoses.front()->scenario, causes, recordings.size()));
  WriteWholeFile(directory / kRecordingsPage,
                 RecordingsPage(diagnoses.front()->scenario, on_page, causes));
}

}  // namespace

std::vector<std::filesystem::path> WriteRecordingsReport(
    const std::filesystem::path& out, const std::vector<DiagnosedRecording>& recordings,
    WholeFolder* whole) {
  std::vector<std::filesystem::path> pages;
  const std::size_t machines = recordings.front().machines.size();
  for (std::size_t m = 0; m < machines; ++m) {
    const std::filesystem::path part = machines == 1 ? "" : recordings.front().machines[m].scenario;
    WriteTogether(whole->temporary() / part, recordings, m);
    pages.push_back(out / part / kRecordingsPage);
  }
  whole->Commit();
  return pages;
}

}  // namespace tera
