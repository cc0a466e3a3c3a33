#include "layout/compare/comparison_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/units.h"
#include "layout/compare/compare_layouts.h"
#include "layout/report/page.h"
#include "layout/report/people_words.h"
#include "layout/report/polar_drawing.h"
#include "layout/report/words.h"
#include "layout/study/zone.h"

namespace tera {
namespace {

constexpr std::array<const char*, 5> kColours = {"a", "b", "c", "d", "e"};
constexpr char kUndecided[] = "not distinguishable over this cycle";

struct MainFigure {
  Measure measure;
  /// `of` is the subject's name; null: the digging shovel; empty: the measure has no named subject.
  const char *of, *words;
};
constexpr std::array<MainFigure, 7> kMain = {
    {{Measure::kSeenBy1, kAroundZone, "space seen"},
     {Measure::kSeenBy2, kAroundZone, "seen by two"},
     {Measure::kDetectedShare, "standing", "standing person"},
     {Measure::kDetectedShare, "crouching", "crouching person"},
     {Measure::kEdgeSeen, nullptr, "cutting edge"},
     {Measure::kLoadSeen, nullptr, "load"},
     {Measure::kElevationGaps, "", "map without gaps"}}};

FigureId IdOf(const MainFigure& main, const LayoutReport& report) {
  return {main.measure, main.of ? main.of : DiggingShovel(report)};
}

/// A text as one CSV cell, quoted if necessary; inner quotes are doubled.
std::string CsvCell(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string cell = "\"";
  for (const char c : text) cell += c == '"' ? "\"\"" : std::string(1, c);
  return cell + '"';
}

std::string Colour(std::size_t layout) { return kColours[layout % kColours.size()]; }

/// Magnitude of a difference and the bounds of its interval. Shares are in percentage points.
std::string SizeText(const Difference& d) {
  const double mean = std::abs(d.of_other - d.of_first);
  const double low = std::min(std::abs(d.low), std::abs(d.high));
  const double high = std::max(std::abs(d.low), std::abs(d.high));
  if (UnitOf(d.figure.measure).empty()) {
    constexpr double kPoints = 100;
    return fmt::format("{:.1f} percentage points ({:.1f} to {:.1f})", kPoints * mean, kPoints * low,
                       kPoints * high);
  }
  return fmt::format("{} ({} to {})", ValueText(d.figure, mean), ValueText(d.figure, low),
                     ValueText(d.figure, high));
}

std::string VerdictText(const Difference& d) {
  if (d.verdict() == Difference::Verdict::kUndecided) return kUndecided;
  return (d.verdict() == Difference::Verdict::kBetter ? "better by " : "worse by ") + SizeText(d);
}

/// Quality of a layout in a main figure, from 0 (bad) to 1.
double Goodness(const Figure& figure) {
  const double mean = std::clamp(MeanOf(figure), 0.0, 1.0);
  return IsMoreBetter(figure.id.measure) ? mean : 1 - mean;
}

constexpr double kRadarMiddle_x = 320, kRadarMiddle_y = 210, kRadar = 150;

Vec2 OnRadar(std::size_t axis, double share) {
  const double angle_rad = 2 * kPi * static_cast<double>(axis) / kMain.size();
  return {kRadarMiddle_x + kRadar * share * std::sin(angle_rad),
          kRadarMiddle_y - kRadar * share * std::cos(angle_rad)};
}

std::string RadarAxes() {
  std::string svg;
  for (const double ring : {0.25, 0.5, 0.75, 1.0}) {
    svg += fmt::format("<circle class=\"grid\" cx=\"{}\" cy=\"{}\" r=\"{}\"/>", kRadarMiddle_x,
                       kRadarMiddle_y, kRadar * ring);
  }
  for (std::size_t axis = 0; axis < kMain.size(); ++axis) {
    const Vec2 end = OnRadar(axis, 1.0), text = OnRadar(axis, 1.12);
    const char* anchor = std::abs(text.x() - kRadarMiddle_x) < 30 ? "middle"
                         : text.x() > kRadarMiddle_x              ? "start"
                                                                  : "end";
    svg += fmt::format(
        "<path class=\"grid\" d=\"M{} {}L{:.1f} {:.1f}\"/><text text-anchor=\"{}\" "
        "x=\"{:.1f}\" y=\"{:.1f}\">{}</text>",
        kRadarMiddle_x, kRadarMiddle_y, end.x(), end.y(), anchor, text.x(), text.y() + 4,
        kMain[axis].words);
  }
  return svg;
}

/// Polygon of a layout's main figures in the radar chart. Absent figures leave a gap.
std::string RadarOutline(const LayoutReport& report, const std::string& colour) {
  std::array<const Figure*, kMain.size()> figures{};
  for (std::size_t axis = 0; axis < kMain.size(); ++axis) {
    figures[axis] = FindFigure(report, IdOf(kMain[axis], report));
  }
  const std::string middle = fmt::format("M{} {}", kRadarMiddle_x, kRadarMiddle_y);
  std::string area, outline;
  for (std::size_t axis = 0; axis < kMain.size(); ++axis) {
    if (!figures[axis]) continue;
    const std::size_t before = (axis + kMain.size() - 1) % kMain.size();
    const std::size_t next = (axis + 1) % kMain.size();
    const Vec2 from = OnRadar(axis, Goodness(*figures[axis]));
    const std::string here = fmt::format("{:.1f} {:.1f}", from.x(), from.y());
    if (!figures[before] || !figures[next]) outline += middle + "L" + here;
    if (!figures[next]) continue;
    const Vec2 to = OnRadar(next, Goodness(*figures[next]));
    const std::string there = fmt::format("{:.1f} {:.1f}", to.x(), to.y());
    outline += "M" + here + "L" + there;
    area += middle + "L" + here + "L" + there + "Z";
  }
  return fmt::format("<path class=\"area {0}\" d=\"{1}\"/><path class=\"outline {0}\" d=\"{2}\"/>",
                     colour, area, outline);
}

/// Names the main figures that layouts lack.
std::string AbsentText(const std::vector<LayoutReport>& reports) {
  std::string html;
  for (const LayoutReport& report : reports) {
    std::vector<const char*> absent;
    for (const MainFigure& main : kMain) {
      if (!FindFigure(report, IdOf(main, report))) absent.push_back(main.words);
    }
    if (absent.empty()) continue;
    html += fmt::format(
        "<p class=\"soft\">{} lacks these figures: {}. The chart has a gap there.</p>\n",
        Escaped(report.name), fmt::join(absent, ", "));
  }
  return html;
}

std::string Radar(const std::vector<LayoutReport>& reports) {
  std::string svg =
      "<svg style=\"max-width:44rem\" viewBox=\"0 0 640 420\" role=\"img\" "
      "aria-label=\"main figures of all layouts\">" +
      RadarAxes();
  for (std::size_t l = 0; l < reports.size(); ++l) svg += RadarOutline(reports[l], Colour(l));
  return svg + "</svg>\n" + AbsentText(reports);
}

std::string Key(const std::vector<LayoutReport>& reports) {
  std::string html = "<p>";
  for (std::size_t l = 0; l < reports.size(); ++l) {
    html += fmt::format("<span class=\"key {}\"></span>{}", Colour(l), Escaped(reports[l].name));
  }
  return html + "</p>\n";
}

/// Map of other minus first, as a share of the map's scale. No value where either has none.
PolarMap DifferenceOf(const PolarMap& first, const PolarMap& other) {
  PolarMap map = other;
  map.low = 0;
  map.ticks.clear();
  map.high = 2;  // zero difference is at the middle of the scale, and no value is negative
  const double scale = first.high - first.low;
  for (std::size_t i = 0; i < map.value.size(); ++i) {
    const bool known = first.value[i] >= 0 && other.value[i] >= 0;
    map.value[i] = known ? std::max(0.0, 1 + (other.value[i] - first.value[i]) / scale) : -1;
  }
  return map;
}

std::string Maps(const std::vector<LayoutReport>& reports) {
  std::string html = "<h2>Coverage around the machine</h2>\n" + MapLegend() +
                     "<p class=\"soft\">Difference maps: blue where the other layout sees more "
                     "often than the first, red where it sees less often.</p>\n";
  const LayoutReport& first = reports.front();
  const std::vector<double> none;
  for (const PolarMap& map : first.maps) {
    const std::vector<double>& outline = IsAboutMachine(map) ? first.outline_m : none;
    html += fmt::format("<h3>{}</h3>\n<div class=\"figures\">\n", Escaped(map.title));
    for (const LayoutReport& report : reports) {
      for (const PolarMap& of : report.maps) {
        if (of.id != map.id || of.value.size() != map.value.size()) continue;
        html += fmt::format("<figure>{}<figcaption>{}</figcaption></figure>\n", MapSvg(of, outline),
                            Escaped(report.name));
        if (&report == &first) continue;
        html += fmt::format("<figure>{}<figcaption>{} against {}</figcaption></figure>\n",
                            MapSvg(DifferenceOf(map, of), outline), Escaped(report.name),
                            Escaped(first.name));
      }
    }
    html += "</div>\n";
  }
  return html;
}

std::string Curves(const std::vector<LayoutReport>& reports) {
  std::string html = "<h2>Detection ranges of people</h2>\n" + Key(reports) +
                     "<p class=\"soft\">Line: farthest distance, mean over the cycle. Filled: "
                     "farthest distance at the worst moment of each direction. " +
                     QuartersText() + "</p>\n<div class=\"figures\">\n";
  for (const PolarCurve& curve : reports.front().curves) {
    std::vector<PolarCurve> curves;
    std::vector<std::string> colours;
    for (std::size_t l = 0; l < reports.size(); ++l) {
      for (const PolarCurve& of : reports[l].curves) {
        if (of.id != curve.id) continue;
        curves.push_back(of);
        colours.push_back(Colour(l));
      }
    }
    html += fmt::format("<figure>{}<figcaption>{}</figcaption></figure>\n",
                        CurvesSvg(curve.title, curve.most, curves, colours), Escaped(curve.title));
  }
  return html + "</div>\n";
}

/// Cost, power and data of each rig.
std::string Expenses(const std::vector<LayoutReport>& reports) {
  std::string html = "<ul>";
  for (const LayoutReport& report : reports) {
    html += fmt::format("<li>{}: {}.</li>", Escaped(report.name), ExpenseText(report.expense));
  }
  return html + "</ul>\n";
}

/// The difference as a share of the larger value.
double RelativeSize(const Difference& d) {
  const double most = std::max(std::abs(d.of_first), std::abs(d.of_other));
  return most > 0 ? std::abs(d.of_other - d.of_first) / most : 0;
}

/// Number of figures in which the other layout is better and worse, and its largest losses.
std::string BalanceText(std::vector<Difference> differences) {
  std::stable_sort(
      differences.begin(), differences.end(),
      [](const Difference& a, const Difference& b) { return RelativeSize(a) > RelativeSize(b); });
  std::size_t better = 0, undecided = 0;
  std::vector<std::string> worse;
  for (const Difference& d : differences) {
    better += d.verdict() == Difference::Verdict::kBetter;
    undecided += d.verdict() == Difference::Verdict::kUndecided;
    if (d.verdict() == Difference::Verdict::kWorse) worse.push_back(Describe(d.figure));
  }
  std::string text = fmt::format(
      "better in {} of {} figures, worse in {}, not distinguishable over this cycle in {}", better,
      differences.size(), worse.size(), undecided);
  constexpr std::size_t kNamed = 6;
  const std::size_t more = worse.size() - std::min(kNamed, worse.size());
  worse.resize(worse.size() - more);
  if (!worse.empty()) text += fmt::format(". Largest losses: {}", fmt::join(worse, "; "));
  return more > 0 ? fmt::format("{}; and {} more", text, more) : text;
}

std::string Table(const LayoutReport& first, const LayoutReport& other) {
  std::string html = fmt::format(
      "<h2>{0} against {1}</h2>\n<div class=\"wide\"><table><tr><th>Figure</th>"
      "<th class=\"r\">{1}</th><th class=\"r\">{0}</th><th>{0} is</th></tr>\n",
      Escaped(other.name), Escaped(first.name));
  for (const Difference& d : Compare(first, other)) {
    const bool better = d.verdict() == Difference::Verdict::kBetter;
    const bool worse = d.verdict() == Difference::Verdict::kWorse;
    html += fmt::format(
        "<tr class=\"{}\"><td>{}</td><td class=\"r\">{}</td><td class=\"r\">{}</td>"
        "<td>{}</td></tr>\n",
        better  ? "better"
        : worse ? "worse"
                : "same",
        Escaped(Describe(d.figure)), Escaped(ValueText(d.figure, d.of_first)),
        Escaped(ValueText(d.figure, d.of_other)), Escaped(VerdictText(d)));
  }
  return html + "</table></div>\n";
}

}  // namespace

std::vector<std::string> ComparisonWords(const std::vector<LayoutReport>& reports) {
  std::vector<std::string> words;
  for (std::size_t l = 1; l < reports.size(); ++l) {
    const std::vector<Difference> differences = Compare(reports.front(), reports[l]);
    const std::string pair = reports[l].name + " against " + reports.front().name;
    words.push_back(fmt::format("{}: {}.", pair, BalanceText(differences)));
    words.push_back(fmt::format("Expense of {}: {}; of {}: {}.", reports[l].name,
                                ExpenseText(reports[l].expense), reports.front().name,
                                ExpenseText(reports.front().expense)));
    for (const MainFigure& main : kMain) {
      const FigureId id = IdOf(main, reports.front());
      const auto found = std::find_if(differences.begin(), differences.end(),
                                      [&](const Difference& d) { return d.figure == id; });
      if (found == differences.end()) continue;
      words.push_back(
          fmt::format("{}, {}: {}.", pair, Describe(found->figure), VerdictText(*found)));
    }
  }
  return words;
}

std::string ComparisonCsv(const std::vector<LayoutReport>& reports) {
  std::string csv = "layout,against,figure,unit,mean,mean_of_other,low,high,verdict\n";
  for (std::size_t l = 1; l < reports.size(); ++l) {
    for (const Difference& d : Compare(reports.front(), reports[l])) {
      constexpr std::array<const char*, 3> kVerdicts = {"better", "worse", "undecided"};
      csv += fmt::format("{},{},{},{},{:.9g},{:.9g},{:.9g},{:.9g},{}\n", CsvCell(reports[l].name),
                         CsvCell(reports.front().name), NameOf(d.figure), UnitOf(d.figure.measure),
                         d.of_other, d.of_first, d.low, d.high,
                         kVerdicts[static_cast<std::size_t>(d.verdict())]);
    }
  }
  return csv;
}

std::string ComparisonPage(const std::vector<LayoutReport>& reports) {
  std::string html = PageBegin("Sensor layouts compared") + "<h1>Which layout sees more?</h1>\n";
  for (const std::string& line : ComparisonWords(reports)) {
    html += fmt::format("<p>{}</p>\n", Escaped(line));
  }
  html +=
      "<p class=\"soft\">Intervals cover 95 %. They come from a block bootstrap over the moments "
      "of the cycle and from the number of sampled places. The seen share and the unseen volume of "
      "a zone are one quantity: a difference counts only if both show it.</p>\n";
  html += "<h2>What they take</h2>\n" + Expenses(reports) + Key(reports) + Radar(reports) +
          Maps(reports) + Curves(reports);
  for (std::size_t l = 1; l < reports.size(); ++l) html += Table(reports.front(), reports[l]);
  return html + PageEnd();
}

}  // namespace tera
