#include "diagnose/report/page/perception_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "diagnose/report/page/svg_plot.h"
#include "diagnose/report/page/table.h"
#include "diagnose/report/text/wording.h"

namespace tera {
namespace {

constexpr int kShades = 6;           ///< on each side of no difference
constexpr double kPixelPerCell = 4;  ///< of the figure's own units
constexpr double kMargin = 44;

/// Extent of a map, in cells.
struct Extent {
  int low_i = std::numeric_limits<int>::max(), high_i = std::numeric_limits<int>::min();
  int low_j = low_i, high_j = high_i;
  double greatest_m = 0;
};

Extent ExtentOf(const GroundMap& map) {
  Extent extent;
  for (const auto& [place, cell] : map.cells) {
    extent.low_i = std::min(extent.low_i, place.first);
    extent.high_i = std::max(extent.high_i, place.first);
    extent.low_j = std::min(extent.low_j, place.second);
    extent.high_j = std::max(extent.high_j, place.second);
    if (cell.region >= 0) extent.greatest_m = std::max(extent.greatest_m, std::abs(cell.above_m));
  }
  return extent;
}

/// -kShades to kShades.
int ShadeOf(double above_m, double greatest_m) {
  return static_cast<int>(std::lround(kShades * std::clamp(above_m / greatest_m, -1.0, 1.0)));
}

/// Runs of neighbours of one shade, as one rectangle each.
std::string Squares(const GroundMap& map, const Extent& extent) {
  std::string svg;
  for (int j = extent.low_j; j <= extent.high_j; ++j) {
    for (int i = extent.low_i; i <= extent.high_i;) {
      const auto first = map.cells.find({i, j});
      if (first == map.cells.end()) {
        ++i;
        continue;
      }
      const int shade = ShadeOf(first->second.above_m, extent.greatest_m);
      int end = i + 1;
      for (; end <= extent.high_i; ++end) {
        const auto next = map.cells.find({end, j});
        if (next == map.cells.end()) break;
        if (ShadeOf(next->second.above_m, extent.greatest_m) != shade) break;
      }
      const double opacity = shade == 0 ? 1 : static_cast<double>(std::abs(shade)) / kShades;
      svg += fmt::format(
          "<rect x='{:.0f}' y='{:.0f}' width='{:.0f}' height='{:.0f}' class='{}' "
          "fill-opacity='{:.2f}'/>\n",
          kMargin + kPixelPerCell * (i - extent.low_i), kPixelPerCell * (extent.high_j - j),
          kPixelPerCell * (end - i), kPixelPerCell,
          shade == 0  ? "level"
          : shade > 0 ? "higher"
                      : "lower",
          opacity);
      i = end;
    }
  }
  return svg;
}

/// Frames about the regions, and their numbers.
std::string Frames(const GroundMap& map, const Extent& extent) {
  std::string svg;
  const auto x = [&](double x_m) {
    return kMargin + kPixelPerCell * (x_m / map.cell_m - extent.low_i);
  };
  const auto y = [&](double y_m) { return kPixelPerCell * (extent.high_j + 1 - y_m / map.cell_m); };
  for (std::size_t r = 0; r < map.regions.size(); ++r) {
    const GroundRegion& region = map.regions[r];
    svg += fmt::format(
        "<rect x='{:.0f}' y='{:.0f}' width='{:.0f}' height='{:.0f}' class='frame'/>"
        "<text class='axis' x='{:.0f}' y='{:.0f}'>{}</text>\n",
        x(region.low_W_m.x()), y(region.high_W_m.y()),
        x(region.high_W_m.x()) - x(region.low_W_m.x()),
        y(region.low_W_m.y()) - y(region.high_W_m.y()), x(region.high_W_m.x()) + 3,
        y(region.high_W_m.y()) + 10, r + 1);
  }
  return svg;
}

std::string Axes(const GroundMap& map, const Extent& extent, double width, double height) {
  std::string svg;
  const PlotAxis x{map.cell_m * extent.low_i, map.cell_m * (extent.high_i + 1), "x, m"};
  const PlotAxis y{map.cell_m * extent.low_j, map.cell_m * (extent.high_j + 1), "y, m"};
  for (const double tick : TicksOf(x, 8)) {
    svg += fmt::format("<text x='{:.0f}' y='{:.0f}' text-anchor='middle'>{:g}</text>\n",
                       kMargin + (tick - x.low) / map.cell_m * kPixelPerCell, height + 16, tick);
  }
  for (const double tick : TicksOf(y, 8)) {
    svg += fmt::format("<text x='{:.0f}' y='{:.0f}' text-anchor='end'>{:g}</text>\n", kMargin - 6,
                       (y.high - tick) / map.cell_m * kPixelPerCell + 4, tick);
  }
  return svg + fmt::format(
                   "<text class='axis' x='{:.0f}' y='{:.0f}' text-anchor='end'>east, m; "
                   "upwards north, m</text>\n",
                   kMargin + width, height + 34);
}

std::string MapFigure(const PerceptionDiagnosis& sensor) {
  const GroundMap& map = sensor.ground;
  if (map.regions.empty()) return "";
  const Extent extent = ExtentOf(map);
  const double width = kPixelPerCell * (extent.high_i - extent.low_i + 1);
  const double height = kPixelPerCell * (extent.high_j - extent.low_j + 1);
  return fmt::format(
      "<figure><svg viewBox='0 0 {:.0f} {:.0f}' role='img' aria-label='Measured ground against "
      "simulated ground'>\n{}{}{}</svg><figcaption>Measured ground over simulated ground, in "
      "squares of {:g} m: <span class='key higher'></span>higher, <span class='key "
      "lower'></span>lower, full colour at {} m; blank where no ray came down.</figcaption>"
      "</figure>\n",
      width + kMargin + 20, height + 40, Squares(map, extent), Frames(map, extent),
      Axes(map, extent, width, height), map.cell_m, Significant(extent.greatest_m, 2));
}

std::string FindingsTable(const PerceptionDiagnosis& sensor) {
  std::vector<const Finding*> findings;
  for (const PerceptionFinding& found : sensor.findings) findings.push_back(&found.finding);
  return findings.empty() ? "" : ParameterTable(findings);
}

std::string DetectabilityTable(const PerceptionDiagnosis& sensor) {
  Table table({"Mechanism", "Parameter", ">Seen from about"});
  for (const ParameterDetectability& one : sensor.detectability) {
    const Mechanism& mechanism = *one.candidate->mechanism;
    const EffectParameter& parameter = mechanism.parameters[one.parameter];
    table.Row({Code(mechanism.id), Code(parameter.name),
               one.smallest ? Significant(*one.smallest, 2) + " " + UnitCell(parameter.unit)
                            : "not at any size"});
  }
  return "<details><summary>Smallest sizes that would have been seen</summary>\n" + table.Take() +
         "</details>\n";
}

}  // namespace

std::string PerceptionSections(const Diagnosis& diagnosis) {
  std::string html;
  for (const PerceptionDiagnosis& sensor : diagnosis.perception) {
    if (!sensor.is_judged()) continue;
    const std::string title = Escaped(Capitalised(Spaced(sensor.target)));
    const double noise = sensor.noise_rmse;
    html += fmt::format("<section>\n<h2>{}</h2>\n<p class='soft'>{} ", title, sensor.scans);
    html += sensor.unit == "m"
                ? fmt::format(
                      "scans of <code>{}</code> beside the same rays in the simulation, on the "
                      "recorded trajectory. Noise: {} cm from the surface.</p>\n",
                      Escaped(sensor.channel), Significant(100 * noise, 2))
                : fmt::format(
                      "pictures of <code>{}</code> beside simulated ones from the recorded "
                      "trajectory. Noise: {} pixels from the edges, in pictures of at most 400 "
                      "pixels' width.</p>\n",
                      Escaped(sensor.channel), Significant(noise, 2));
    html += MapFigure(sensor) + FindingsTable(sensor) + DetectabilityTable(sensor) + "</section>\n";
  }
  return html;
}

std::string GroundCsv(const GroundMap& map) {
  std::string csv = "x_m,y_m,above_m,sigma_m,region,seen\n";
  for (const auto& [place, cell] : map.cells) {
    csv += fmt::format("{:g},{:g},{:.4f},{:.4f},{},{}\n", map.cell_m * (place.first + 0.5),
                       map.cell_m * (place.second + 0.5), cell.above_m, cell.sigma_m, cell.region,
                       cell.seen ? 1 : 0);
  }
  return csv;
}

}  // namespace tera
