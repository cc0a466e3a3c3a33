#include "diagnose/report/files/write_report.h"

#include "dataset/files/checked_file.h"
#include "diagnose/report/files/diagnosis_json.h"
#include "diagnose/report/files/effects_yaml.h"
#include "diagnose/report/page/html_report.h"
#include "diagnose/report/page/perception_figures.h"
#include "diagnose/report/text/next_manoeuvre_text.h"

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
