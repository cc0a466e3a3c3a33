#include "layout/optimise/found_files.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/config/config.h"
#include "dataset/files/checked_file.h"
#include "layout/report/page.h"
#include "layout/report/words.h"

namespace tera {
namespace fs = std::filesystem;
namespace {

/// YAML of the kept rig, with all references resolved. Empty without a kept rig.
std::string KeptYaml(const LayoutSearch& search) {
  if (search.keep.empty()) return "";
  const Config config = Config::FromFile(search.keep);
  const std::vector<ConfigMap> sensors = config.root().List("sensors");
  if (sensors.empty()) return "";
  for (const ConfigMap& item : sensors) ReadSensor(item);
  config.Finish();
  return config.ResolvedYaml();
}

std::string NameOf(std::size_t number) { return fmt::format("{:02}", number + 1); }

std::string FrontCsv(const LayoutSearch& search, const OptimiseResult& result) {
  std::string csv = "rig";
  for (const Objective& objective : search.objectives) {
    csv += fmt::format(",{}{}", objective.figure, objective.at_worst ? " (worst)" : "");
  }
  csv += "\n";
  const auto row = [&](const std::string& rig, const FoundLayout& found) {
    csv += rig;
    for (const double objective : found.objectives) {
      csv += fmt::format(",{:.9g}", objective);
    }
    csv += "\n";
  };
  for (std::size_t i = 0; i < result.front.size(); ++i) {
    row("front/" + NameOf(i) + ".yaml", result.front[i]);
  }
  if (result.greedy) row("greedy.yaml", *result.greedy);
  return csv;
}

std::string HypervolumeCsv(const std::vector<double>& hypervolume) {
  std::string csv = "generation,hypervolume\n";
  for (std::size_t g = 0; g < hypervolume.size(); ++g) {
    csv += fmt::format("{},{:.9g}\n", g, hypervolume[g]);
  }
  return csv;
}

/// Labels of points in a picture, each next to its point without overlap.
class Labels {
 public:
  /// The label as SVG. Empty if there is no room.
  std::string At(const Vec2& point, const std::string& text) {
    constexpr double kLetter = 7.5, kHeight = 13, kGap = 7;
    const double width = kLetter * static_cast<double>(text.size());
    for (const Vec2& corner :
         {Vec2(point.x() + kGap, point.y() + 4), Vec2(point.x() - kGap - width, point.y() + 4),
          Vec2(point.x() - 0.5 * width, point.y() - kGap),
          Vec2(point.x() - 0.5 * width, point.y() + kGap + kHeight)}) {
      const Vec2 high = corner + Vec2(width, kHeight);
      const bool is_taken = std::any_of(boxes_.begin(), boxes_.end(), [&](const auto& box) {
        return (corner.array() < box.second.array()).all() &&
               (high.array() > box.first.array()).all();
      });
      if (is_taken) continue;
      boxes_.emplace_back(corner, high);
      return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\">{}</text>", corner.x(), corner.y(), text);
    }
    return "";
  }

 private:
  std::vector<std::pair<Vec2, Vec2>> boxes_;
};

/// Scatter plot of the first two objectives of the layouts on the front.
std::string Scatter(const LayoutSearch& search, const OptimiseResult& result) {
  if (search.objectives.size() < 2) return "";
  std::vector<Vec2> points;
  for (const FoundLayout& f : result.front) {
    points.emplace_back(f.objectives[0], f.objectives[1]);
  }
  if (result.greedy) {
    points.emplace_back(result.greedy->objectives[0], result.greedy->objectives[1]);
  }
  Vec2 low = points.front(), high = points.front();
  for (const Vec2& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const Vec2 span = (high - low).cwiseMax(1e-9);
  const auto at = [&](const Vec2& p) {
    return Vec2(60 + 520 * (p.x() - low.x()) / span.x(), 300 - 260 * (p.y() - low.y()) / span.y());
  };
  std::string svg =
      "<svg style=\"max-width:44rem\" viewBox=\"0 0 640 350\" role=\"img\" aria-label=\"front\">"
      "<path class=\"grid\" d=\"M50 20V310H600\"/>";
  Labels labels;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec2 p = at(points[i]);
    const bool is_greedy = i == result.front.size();
    svg += fmt::format(
        "<circle class=\"area {}\" style=\"fill-opacity:.9\" cx=\"{:.1f}\" "
        "cy=\"{:.1f}\" r=\"5\"><title>{}</title></circle>",
        is_greedy ? "b" : "a", p.x(), p.y(), is_greedy ? "greedy" : NameOf(i));
    svg += labels.At(p, is_greedy ? "greedy" : NameOf(i));
  }
  svg += fmt::format(
      "<text x=\"60\" y=\"330\">{:.4g}</text><text x=\"560\" y=\"330\">{:.4g}</text>"
      "<text x=\"2\" y=\"300\">{:.4g}</text><text x=\"2\" y=\"44\">{:.4g}</text>"
      "<text x=\"230\" y=\"345\">{}</text><text x=\"60\" y=\"16\">{}</text></svg>\n",
      low.x(), high.x(), low.y(), high.y(), Escaped(search.objectives[0].figure),
      Escaped(search.objectives[1].figure));
  return svg;
}

std::string SearchPage(const LayoutSearch& search, const OptimiseResult& result) {
  std::string html = PageBegin("Sensor layouts found") + "<h1>Layouts on the Pareto front</h1>\n";
  html += fmt::format(
      "<p class=\"answer\">{} on the front: no other layout is better in every objective.</p>\n<p "
      "class=\"soft\">Each layout is a rig file in front/ for tera generate and tera layout "
      "evaluate. Objectives cover the {} moments of the search. Evaluate a layout for more "
      "moments, more places and sampling errors.</p>\n",
      LayoutCount(result.front.size()), search.moments);
  for (const std::string& warning : result.warnings) {
    html += fmt::format("<p class=\"warning\">{}</p>\n", Escaped(warning));
  }
  html += Scatter(search, result) + "<div class=\"wide\"><table><tr><th>Rig</th>";
  for (const Objective& objective : search.objectives) {
    html += fmt::format("<th class=\"r\">{}{}</th>", Escaped(objective.figure),
                        objective.at_worst ? ", worst moment" : ", mean");
  }
  html += "<th>Sensors</th></tr>\n";
  const auto row = [&](const std::string& rig, const FoundLayout& found) {
    html += "<tr><td>" + rig + "</td>";
    for (const double objective : found.objectives) {
      html += fmt::format("<td class=\"r\">{:.4g}</td>", objective);
    }
    std::vector<std::string> names;
    for (const SensorDescription& sensor : SensorsOf(search, found.genes)) {
      names.push_back(fmt::format("{} on {}", sensor.name, sensor.link));
    }
    html += fmt::format("<td>{}</td></tr>\n", Escaped(fmt::format("{}", fmt::join(names, ", "))));
  };
  for (std::size_t i = 0; i < result.front.size(); ++i) {
    row("front/" + NameOf(i) + ".yaml", result.front[i]);
  }
  if (result.greedy) row("greedy.yaml", *result.greedy);
  return html + "</table></div>\n" + PageEnd();
}

}  // namespace

std::string LayoutCount(std::size_t count) {
  return count == 1 ? "1 layout" : fmt::format("{} layouts", count);
}

std::vector<double> ShownValues(const std::vector<double>& objectives,
                                const std::vector<double>& signs) {
  std::vector<double> values;
  // Turns -0 into 0.
  for (std::size_t i = 0; i < signs.size(); ++i) values.push_back(signs[i] * objectives[i] + 0.0);
  return values;
}

void WriteFound(const LayoutSearch& search, const std::vector<double>& signs,
                const OptimiseResult& found, const std::vector<double>& hypervolume,
                const fs::path& folder) {
  OptimiseResult result = found;  // a copy whose objectives are values of figures
  for (FoundLayout& layout : result.front)
    layout.objectives = ShownValues(layout.objectives, signs);
  if (result.greedy) {
    result.greedy->objectives = ShownValues(result.greedy->objectives, signs);
  }
  MakeFolder(folder / "front");
  const std::string kept = KeptYaml(search);
  for (std::size_t i = 0; i < result.front.size(); ++i) {
    WriteWholeFile(folder / "front" / (NameOf(i) + ".yaml"),
                   RigYaml(search, result.front[i].genes, kept));
  }
  if (result.greedy) {
    WriteWholeFile(folder / "greedy.yaml", RigYaml(search, result.greedy->genes, kept));
  }
  WriteWholeFile(folder / "front.csv", FrontCsv(search, result));
  WriteWholeFile(folder / "hypervolume.csv", HypervolumeCsv(hypervolume));
  WriteWholeFile(folder / "search.html", SearchPage(search, result));
}

}  // namespace tera
