#include "diagnose/report/files/write_report.h"

#include "core/error.h"
#include "dataset/files/checked_file.h"
#include "diagnose/report/files/diagnosis_json.h"
#include "diagnose/report/files/effects_yaml.h"
#include "diagnose/report/files/ground_map_file.h"
#include "diagnose/report/files/series_csv.h"
#include "diagnose/report/page/html_report.h"
#include "diagnose/report/page/perception_figures.h"
#include "diagnose/report/text/next_manoeuvre_text.h"

namespace tera {
namespace {

/// Each channel that was judged, over time.
void WriteSeries(const std::filesystem::path& directory, const Diagnosis& diagnosis) {
  for (const DiagnosedBlock& diagnosed : diagnosis.blocks) {
    if (!HasSeries(diagnosed)) continue;
    for (std::size_t c = 0; c < diagnosed.block.channels.size(); ++c) {
      WriteWholeFile(directory / SeriesFileName(diagnosed.block.channels[c].name),
                     SeriesCsv(diagnosed, c));
    }
  }
}

}  // namespace

void WriteReport(const std::filesystem::path& directory, const Diagnosis& diagnosis,
                 const std::string& recording) {
  MakeWritableFolder(directory);
  WriteWholeFile(directory / "diagnosis.json", DiagnosisJson(diagnosis));
  WriteWholeFile(directory / "effects.yaml", EffectsYaml(diagnosis, recording));
  if (diagnosis.next) WriteWholeFile(directory / kNextManoeuvreFile, CsvOf(*diagnosis.next));
  WriteWholeFile(directory / "report.html", HtmlReport(diagnosis, recording));
  for (const PerceptionDiagnosis& sensor : diagnosis.perception) {
    if (sensor.ground.cells.empty()) continue;
    WriteWholeFile(directory / ("ground_" + sensor.target + ".csv"), GroundCsv(sensor.ground));
  }
  WriteGroundMaps(directory, diagnosis);
  WriteSeries(directory, diagnosis);
}

void RequireNewFolder(const std::filesystem::path& out) {
  RequireNoneStopped(out);
  if (!std::filesystem::exists(out)) return;
  throw InputError(out.string(),
                   {FaultKind::kUnwritable,
                    "exists already; need the name of a new folder, for a report of its own"});
}

std::vector<std::filesystem::path> ReportFolder::Write(const std::vector<Diagnosis>& diagnoses,
                                                       const Recording& recording) {
  std::vector<std::filesystem::path> pages;
  for (const Diagnosis& diagnosis : diagnoses) {
    const std::filesystem::path part = diagnoses.size() == 1 ? "" : diagnosis.machine;
    WriteReport(whole_.temporary() / part, diagnosis, recording.directory().string());
    pages.push_back(out_ / part / "report.html");
  }
  whole_.Commit();
  return pages;
}

}  // namespace tera
