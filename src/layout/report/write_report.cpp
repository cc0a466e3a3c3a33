#include "layout/report/write_report.h"

#include <fmt/format.h>

#include <algorithm>

#include "dataset/files/checked_file.h"
#include "dataset/format/png.h"
#include "layout/measures/quarter.h"
#include "layout/report/answer.h"
#include "layout/report/page.h"
#include "layout/report/people_words.h"
#include "layout/report/polar_drawing.h"
#include "layout/report/report_json.h"
#include "layout/report/words.h"

namespace tera {
namespace fs = std::filesystem;
namespace {

constexpr int kMap_px = 480;
constexpr double kPercentShare = 100;
using Measures = std::vector<Measure>;
const Measures kProbabilities = {Measure::kProbabilityMap, Measure::kWorstProbabilityMap};

bool IsAnyOf(const FigureId& id, const Measures& measures) {
  return std::find(measures.begin(), measures.end(), id.measure) != measures.end();
}
/// Smallest share that the page lists; the CSV tables list all.
constexpr double kLeastShown = 0.005;

std::string FiguresCsv(const LayoutReport& report) {
  std::string csv = "figure,unit,more_is_better,mean,worst,sampling_error\n";
  for (const Figure& f : report.figures) {
    csv += fmt::format("{},{},{},{:.9g},{:.9g},{:.9g}\n", NameOf(f.id), UnitOf(f.id.measure),
                       int{IsMoreBetter(f.id.measure)}, MeanOf(f), WorstOf(f), ErrorOf(f));
  }
  return csv;
}

std::string MomentsCsv(const LayoutReport& report) {
  std::string csv = "t_s";
  for (const Figure& f : report.figures) csv += "," + NameOf(f.id);
  csv += "\n";
  for (std::size_t m = 0; m < report.t_s.size(); ++m) {
    csv += fmt::format("{:.9g}", report.t_s[m]);
    for (const Figure& f : report.figures) csv += fmt::format(",{:.9g}", f.at[m]);
    csv += "\n";
  }
  return csv;
}

std::string BlindCsv(const LayoutReport& report) {
  std::string csv = "zone,cause,share\n";
  for (const auto& [zone, causes] : report.blind_causes) {
    for (const auto& [cause, share] : causes) {
      csv += fmt::format("{},{},{:.9g}\n", zone, cause, share);
    }
  }
  return csv;
}

/// The maps of people as CSV, one row per place. Azimuths as in PolarMap; distances from the
/// machine's outline.
std::string PeopleCsv(const LayoutReport& report) {
  constexpr double kTurn_deg = 360;
  std::string csv = "map,azimuth_deg,distance_m,probability\n";
  for (const PolarMap& map : report.maps) {
    if (!IsAnyOf(map.id, kProbabilities)) continue;
    for (int sector = 0; sector < map.sectors; ++sector) {
      for (int ring = 0; ring < map.rings; ++ring) {
        const double value = map.value[static_cast<std::size_t>(sector * map.rings + ring)];
        if (value < 0) continue;
        csv += fmt::format("{},{:.9g},{:.9g},{:.9g}\n", NameOf(map.id),
                           sector * kTurn_deg / map.sectors, (ring + 1) * map.ring_m, value);
      }
    }
  }
  return csv;
}

/// A map's name as a file name: "seen_0.9_m".
std::string FileName(std::string name) {
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == '/' || c == ' '; }, '_');
  return name;
}

/// Explanation of a map's colours.
std::string ColoursText(const PolarMap& map) {
  const std::string dark = map.ticks.empty() ? "" : "; dark grey: none at all";
  return fmt::format("from red to blue: {:.4g}{}", fmt::join(TicksOf(map), ", "), dark);
}

/// Maps of these measures, under a heading.
std::string MapFigures(const LayoutReport& report, const Measures& measures,
                       const std::string& heading) {
  const std::vector<double> none;
  std::string figures;
  for (const PolarMap& map : report.maps) {
    if (!IsAnyOf(map.id, measures)) continue;
    figures += fmt::format("<figure>{}<figcaption>{}, {}</figcaption></figure>\n",
                           MapSvg(map, IsAboutMachine(map) ? report.outline_m : none),
                           Escaped(map.title), ColoursText(map));
  }
  if (figures.empty()) return "";
  return heading + "<div class=\"figures\">\n" + figures + "</div>\n";
}

std::string CurveFigures(const LayoutReport& report, Measure measure) {
  std::string figures;
  for (const PolarCurve& curve : report.curves) {
    if (curve.id.measure != measure) continue;
    figures +=
        fmt::format("<figure>{}<figcaption>{}</figcaption></figure>\n",
                    CurvesSvg(curve.title, curve.most, {curve}, {"a"}), Escaped(curve.title));
  }
  if (figures.empty()) return "";
  return "<p class=\"soft\">Line: farthest distance, mean over the cycle. Filled: farthest "
         "distance at the worst moment of each direction.</p>\n<div class=\"figures\">\n" +
         figures + "</div>\n";
}

/// Ranges of detection of people in each quarter.
std::string PeopleTable(const LayoutReport& report) {
  std::string rows;
  for (const std::string& posture : PosturesOf(report)) {
    for (std::size_t q = 0; q < kQuarters.size(); ++q) {
      const auto always = AlwaysDetectedIn(report, posture, q);
      if (!always) continue;
      const Figure& over = *FindFigure(report, {Measure::kDetectedOver, posture, q});
      rows += fmt::format(
          "<tr><td>{}</td><td>{}</td><td>{}</td><td class=\"r\">{}</td><td "
          "class=\"r\">{}</td></tr>\n",
          Escaped(posture), kQuarters[q].name, RangeText(*always),
          Escaped(ValueText(over.id, MeanOf(over))), Escaped(ValueText(over.id, WorstOf(over))));
    }
  }
  if (rows.empty()) return "";
  return "<div class=\"wide\"><table><tr><th>Person</th><th>Every direction within 45° "
         "of</th><th>Detected at every moment</th><th class=\"r\">Total length of distances with "
         "detection, mean</th><th class=\"r\">Worst moment</th></tr>\n" +
         rows + "</table></div>\n";
}

std::string PeopleSection(const LayoutReport& report) {
  const std::string shown = PeopleTable(report) + MapFigures(report, {Measure::kDetectedMap}, "") +
                            CurveFigures(report, Measure::kPersonCurve);
  if (shown.empty()) return "";
  return "<h2>Detection ranges of people</h2>\n<p class=\"soft\">" + QuartersText() + "</p>\n" +
         shown;
}

std::string FigureTable(const LayoutReport& report) {
  std::string html =
      "<h2>All figures</h2>\n<p class=\"soft\">The sampling error is one standard deviation and "
      "depends on the number of sampled places.</p>\n<p class=\"soft\">" +
      QuartersText() +
      "</p>\n<div class=\"wide\"><table><tr><th>Figure</th>"
      "<th class=\"r\">Mean</th><th class=\"r\">Worst moment</th><th class=\"r\">Sampling "
      "error</th></tr>\n";
  for (const Figure& f : report.figures) {
    html += fmt::format(
        "<tr><td>{}</td><td class=\"r\">{}</td><td class=\"r\">{}</td>"
        "<td class=\"r\">{}</td></tr>\n",
        Escaped(Describe(f.id)), Escaped(ValueText(f.id, MeanOf(f))),
        Escaped(ValueText(f.id, WorstOf(f))),
        f.error.empty() ? "-" : Escaped(ValueText(f.id, ErrorOf(f))));
  }
  return html + "</table></div>\n";
}

/// HTML table of shares under two levels of names.
std::string ShareTable(const std::string& heading, const char* first, const char* second,
                       const std::map<std::string, std::map<std::string, double>>& shares) {
  std::string rows;
  for (const auto& [zone, of_zone] : shares) {
    std::vector<std::pair<double, std::string>> sorted;
    for (const auto& [name, share] : of_zone) sorted.emplace_back(share, name);
    std::sort(sorted.rbegin(), sorted.rend());
    for (const auto& [share, name] : sorted) {
      if (share < kLeastShown) continue;
      rows += fmt::format("<tr><td>{}</td><td>{}</td><td class=\"r\">{:.1f} %</td></tr>\n",
                          Escaped(zone), Escaped(name), kPercentShare * share);
    }
  }
  if (rows.empty()) return "";
  return fmt::format(
      "<h2>{}</h2>\n<div class=\"wide\"><table><tr><th>{}</th><th>{}</th>"
      "<th class=\"r\">Share</th></tr>\n{}</table></div>\n",
      heading, first, second, rows);
}

}  // namespace

std::string ReportPage(const LayoutReport& report) {
  std::string html = PageBegin("Sensor layout " + report.name);
  html += fmt::format("<h1>Coverage of the layout “{}”</h1>\n", Escaped(report.name));
  for (const std::string& line : Answer(report)) {
    html += fmt::format("<p class=\"answer\">{}</p>\n", Escaped(line));
  }
  for (const std::string& warning : report.warnings) {
    html += fmt::format("<p class=\"warning\">{}</p>\n", Escaped(warning));
  }
  html += fmt::format(
      "<p class=\"soft\">Rig {}; lidars and cameras: {}. Cycle {}: {} from {:.1f} to {:.1f} s. "
      "Expense: {}.</p>\n",
      Escaped(report.file), Escaped(fmt::format("{}", fmt::join(report.viewers, ", "))),
      Escaped(report.cycle),
      report.t_s.size() == 1 ? "1 moment" : fmt::format("{} moments", report.t_s.size()),
      report.t_s.front(), report.t_s.back(), ExpenseText(report.expense));
  html += MapFigures(report, {Measure::kSeenMap},
                     "<h2>Coverage around the machine</h2>\n" + MapLegend());
  html += PeopleSection(report);
  html += MapFigures(report, kProbabilities,
                     "<h2>Probability that lidars detect a person</h2>\n<p class=\"soft\">A "
                     "cluster detector needs a minimum number of points on a person; clutter and "
                     "false alarms are not modelled.</p>\n");
  html +=
      MapFigures(report, {Measure::kPixelMap}, "<h2>Pixel density of cameras on a person</h2>\n");
  html += CurveFigures(report, Measure::kPixelCurve);
  html += MapFigures(report, {Measure::kSkyHidden}, "<h2>Sky view of antennas</h2>\n");
  html += ShareTable("Causes of blind places", "Zone", "Cause", report.blind_causes);
  html += ShareTable("Places seen by two sensors", "Zone", "Sensors", report.overlaps);
  return html + FigureTable(report) + PageEnd();
}

void WriteReport(const LayoutReport& report, const fs::path& folder) {
  MakeFolder(folder / "maps");
  WriteWholeFile(folder / "layout.json", ReportJson(report));
  WriteWholeFile(folder / "figures.csv", FiguresCsv(report));
  WriteWholeFile(folder / "moments.csv", MomentsCsv(report));
  WriteWholeFile(folder / "blind.csv", BlindCsv(report));
  WriteWholeFile(folder / "people.csv", PeopleCsv(report));
  for (const PolarMap& map : report.maps) {
    WriteWholeFile(folder / "maps" / (FileName(NameOf(map.id)) + ".png"),
                   EncodeRgbPng(DrawMapWithWords(map, kMap_px)));
  }
  WriteWholeFile(folder / "report.html", ReportPage(report));
}

}  // namespace tera
