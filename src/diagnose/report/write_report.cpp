#include "diagnose/report/write_report.h"

#include "dataset/checked_file.h"
#include "diagnose/report/diagnosis_json.h"
#include "diagnose/report/effects_yaml.h"
#include "diagnose/report/html_report.h"
#include "diagnose/report/next_manoeuvre_text.h"
#include "diagnose/report/perception_figures.h"

namespace tera {

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
}

}  // namespace tera
