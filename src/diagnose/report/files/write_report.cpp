#include "diagnose/report/files/write_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <limits>
#include <string>

#include "core/error.h"
#include "dataset/files/checked_file.h"
#include "diagnose/diagnosed_block.h"
#include "diagnose/diagnosis.h"
#include "diagnose/report/files/diagnosis_json.h"
#include "diagnose/report/files/effects_yaml.h"
#include "diagnose/report/page/html_report.h"
#include "diagnose/report/text/confirmation_text.h"
#include "soil/site/map_raster.h"

namespace tera {
namespace {

/// Unit of a channel's name: "_radps" of "excavator1/encoders/boom_radps". Empty without a unit.
std::string UnitOf(const std::string& channel) {
  const std::size_t at = channel.rfind('_');
  return at == std::string::npos || channel.find('/', at) != std::string::npos ? ""
                                                                               : channel.substr(at);
}

/// File of a channel's series: "series_excavator1_encoders_boom_radps.csv".
std::string SeriesFileName(const std::string& channel) {
  std::string name = "series_" + channel + ".csv";
  std::replace(name.begin(), name.end(), '/', '_');
  return name;
}

/// True if the block was replayed and therefore has series.
bool HasSeries(const DiagnosedBlock& diagnosed) {
  const std::size_t channels = diagnosed.block.channels.size();
  const SearchResult& search = diagnosed.diagnosis.search;
  return search.nothing.misfit.residual.size() == channels &&
         search.found.misfit.residual.size() == channels;
}

/// Series of a judged channel in its unit: t_ns, the measurement, the prediction before and after,
/// and both residuals. One row per grid sample at which all values are known.
std::string SeriesCsv(const DiagnosedBlock& diagnosed, std::size_t channel) {
  const ReplayBlock& block = diagnosed.block;
  const Series& measured = block.channels[channel].measured;
  const Series& before = diagnosed.diagnosis.search.nothing.misfit.residual[channel];
  const Series& after = diagnosed.diagnosis.search.found.misfit.residual[channel];
  const std::string unit = UnitOf(block.channels[channel].name);
  std::string csv = fmt::format(
      "t_ns,measured{0},simulated_before{0},simulated_after{0},error_before{0},error_after{0}\n",
      unit);
  for (std::size_t k = 0; k < measured.size(); ++k) {
    if (!measured.valid[k] || !before.valid[k] || !after.valid[k]) continue;
    const double m = measured.value[k], b = before.value[k], a = after.value[k];
    fmt::format_to(std::back_inserter(csv), "{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g}\n",
                   std::llround(1e9 * block.time_s(k)), m, m - b, m - a, b, a);
  }
  return csv;
}

/// Measured minus simulated ground height in metres.
SiteMap AsSiteMap(const GroundMap& ground) {
  auto [low_i, low_j] = ground.cells.begin()->first;
  int high_i = low_i, high_j = low_j;
  for (const auto& [place, cell] : ground.cells) {
    low_i = std::min(low_i, place.first);
    high_i = std::max(high_i, place.first);
    low_j = std::min(low_j, place.second);
    high_j = std::max(high_j, place.second);
  }
  SiteMap map;
  map.low_W_m = ground.cell_m * Vec2(low_i, low_j);
  map.square_m = ground.cell_m;
  map.nx = high_i - low_i + 1;
  map.ny = high_j - low_j + 1;
  map.unit = "m";
  map.description = "measured ground over simulated ground";
  map.values.assign(static_cast<std::size_t>(map.nx) * map.ny,
                    std::numeric_limits<float>::quiet_NaN());
  for (const auto& [place, cell] : ground.cells) {
    const auto row = static_cast<std::size_t>(place.second - low_j);
    map.values[row * map.nx + (place.first - low_i)] = static_cast<float>(cell.above_m);
  }
  return map;
}

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
    WriteSiteMap(directory / ("ground_" + sensor.target + ".tif"), AsSiteMap(sensor.ground),
                 diagnosis.origin);
  }
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
