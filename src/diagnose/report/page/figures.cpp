#include "diagnose/report/page/figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "diagnose/report/page/svg_plot.h"
#include "diagnose/report/text/sentence.h"
#include "diagnose/report/text/words.h"

namespace tera {
namespace {

constexpr std::size_t kMostPoints = 1500;  ///< maximum per line
constexpr double kLongestWindow_s = 10;    ///< longest window of measured and predicted values
constexpr int kShades = 6;                 ///< colours of a map, per sign of the difference
constexpr double kLongestSide = 400;       ///< longer side of a map, in SVG units

std::string Figure(const std::string& picture, const std::string& caption) {
  return fmt::format("<figure>{}<figcaption>{}</figcaption></figure>\n", picture, caption);
}

std::string Key(std::string_view css_class, std::string_view text) {
  return fmt::format("<span class='entry'><span class='key {}'></span>{}</span> ", css_class, text);
}

std::string KeyOfFound(const SearchResult& search) {
  return search.found.terms.empty() ? "" : Key("after", "with all that was found");
}

std::string LabelWithUnit(const std::string& name, const ReadableUnit& unit) {
  return unit.name.empty() ? Capitalised(name)
                           : fmt::format("{}, {}", Capitalised(name), unit.name);
}

Series Predicted(const Series& measured, const Series& residual) {
  Series predicted = measured;
  for (std::size_t k = 0; k < measured.size(); ++k) predicted.value[k] -= residual.value[k];
  predicted.valid = Both(measured.valid, residual.valid);
  return predicted;
}

/// Envelope of a series (EnvelopeOf) over the recording's time.
std::vector<PlotPoint> LineOf(const ReplayBlock& block, const Series& series,
                              const Segment& samples, double factor) {
  std::vector<PlotPoint> line = EnvelopeOf(series, samples, factor, kMostPoints);
  for (PlotPoint& point : line) point.x += block.time_s(0);
  return line;
}

/// The window of `length` samples within a segment with the largest sum of squares.
Segment Worst(const Series& residual, const Segment& within, std::size_t length) {
  if (within.size() <= length) return within;
  const auto square = [&](std::size_t k) {
    return residual.valid[k] ? residual.value[k] * residual.value[k] : 0.0;
  };
  double sum = 0;
  for (std::size_t k = within.begin; k < within.begin + length; ++k) sum += square(k);
  double most = sum;
  Segment worst{within.begin, within.begin + length};
  for (std::size_t k = within.begin + length; k < within.end; ++k) {
    sum += square(k) - square(k - length);
    if (sum <= most) continue;
    most = sum;
    worst = {k + 1 - length, k + 1};
  }
  return worst;
}

/// Window of PredictionFigure: the worst interval with a margin before and after.
Segment WindowOf(const DiagnosedBlock& diagnosed, const Location& location) {
  const std::size_t samples = diagnosed.block.samples();
  const Segment worst =
      location.intervals.empty() ? Segment{0, samples} : location.intervals[location.worst];
  const std::size_t margin = worst.size() / 10;
  const Segment window{worst.begin - std::min(margin, worst.begin),
                       std::min(worst.end + margin, samples)};
  const auto most = static_cast<std::size_t>(kLongestWindow_s / diagnosed.block.period_s());
  return Worst(diagnosed.diagnosis.search.nothing.misfit.residual[location.channel], window,
               std::max<std::size_t>(most, 2));
}

/// Axis over all points. On each side, at most the share `outliers` of the points lies outside.
PlotAxis RangeOf(const std::vector<std::vector<PlotPoint>>& lines, double outliers,
                 std::string label) {
  std::vector<double> all;
  for (const auto& line : lines) {
    for (const PlotPoint& point : line) {
      if (std::isfinite(point.y)) all.push_back(point.y);
    }
  }
  if (all.empty()) return Widened(0, 0, std::move(label));
  std::sort(all.begin(), all.end());
  const auto cut = static_cast<std::size_t>(outliers * static_cast<double>(all.size()));
  return Widened(all[cut], all[all.size() - 1 - cut], std::move(label));
}

}  // namespace

std::string PredictionFigure(const DiagnosedBlock& diagnosed, const Location& location) {
  const Segment window = WindowOf(diagnosed, location);
  const Channel& channel = diagnosed.block.channels[location.channel];
  const SearchResult& search = diagnosed.diagnosis.search;
  const ReadableUnit unit = ReadableUnitOf(channel.unit);
  const auto line = [&](const Series& series) {
    return LineOf(diagnosed.block, series, window, unit.factor);
  };
  const auto predicted = [&](const FittedStructure& structure) {
    return line(Predicted(channel.measured, structure.misfit.residual[location.channel]));
  };
  const auto measured = line(channel.measured), before = predicted(search.nothing),
             after = predicted(search.found);
  const ReplayBlock& block = diagnosed.block;
  SvgPlot plot("measured and predicted over time",
               {block.time_s(window.begin), block.time_s(window.end), "Time, s"},
               RangeOf({measured, before, after}, 0, LabelWithUnit(QuantityOf(channel.name), unit)),
               480);
  plot.Horizontal(0, "zero");
  plot.Line(measured, "line measured");
  plot.Line(before, "line before");
  if (!search.found.terms.empty()) plot.Line(after, "line after");
  return Figure(plot.Take(), Key("measured", "measured") + Key("before", "simulated before") +
                                 KeyOfFound(search));
}

std::string ResidualFigure(const DiagnosedBlock& diagnosed, const Location& location) {
  const Channel& channel = diagnosed.block.channels[location.channel];
  const SearchResult& search = diagnosed.diagnosis.search;
  const ReadableUnit unit = ReadableUnitOf(channel.unit);
  const Segment all{0, diagnosed.block.samples()};
  const auto line = [&](const FittedStructure& structure) {
    return LineOf(diagnosed.block, structure.misfit.residual[location.channel], all, unit.factor);
  };
  const auto before = line(search.nothing), after = line(search.found);
  const ReplayBlock& block = diagnosed.block;
  SvgPlot plot("residual over the recording", {block.time_s(0), block.time_s(all.end), "Time, s"},
               RangeOf({before, after}, 0.002, LabelWithUnit("measured − simulated", unit)));
  for (const Segment& interval : location.intervals) {
    plot.Shade(block.time_s(interval.begin), block.time_s(interval.end));
  }
  plot.Line(before, "thin before");
  if (!search.found.terms.empty()) plot.Line(after, "thin after");
  plot.Horizontal(0, "zero");
  return Figure(plot.Take(), Key("before", "residual as it was, nominal numbers fitted") +
                                 KeyOfFound(search) + Key("shaded", "where the error stands out"));
}

std::string RegimeFigure(const DiagnosedBlock& diagnosed, const Location& location,
                         const Regime& regime, const std::string& error) {
  const Channel& channel = diagnosed.block.channels[location.channel];
  const RegimeCurve& bins = regime.curve;
  const ReadableUnit x_unit = ReadableUnitOf(UnitOfVariable(regime.variable, channel.unit));
  const ReadableUnit y_unit = ReadableUnitOf(regime.is_share ? "1" : channel.unit);
  std::vector<PlotPoint> mean, low, high, counts;
  for (Eigen::Index b = 0; b < bins.at.size(); ++b) {
    if (bins.count[b] <= 0) continue;
    const double x = x_unit.factor * bins.at[b];
    mean.push_back({x, y_unit.factor * bins.mean[b]});
    low.push_back({x, y_unit.factor * bins.low[b]});
    high.push_back({x, y_unit.factor * bins.high[b]});
    counts.push_back({x, bins.count[b]});
  }
  if (counts.empty()) return "";
  const std::string variable = VariableText(regime.variable, diagnosed.block);
  const char* const error_name =
      regime.is_share ? "error / simulated, less mean" : "error, less mean";
  SvgPlot plot("as a function of " + regime.variable,
               Widened(mean.front().x, mean.back().x, LabelWithUnit(variable, x_unit)),
               RangeOf({low, high, {{0, 0}}}, 0, LabelWithUnit(error_name, y_unit)), 480, 280);
  const CurveShape& shape = regime.shape;
  const double shape_low = x_unit.factor * shape.low, shape_high = x_unit.factor * shape.high;
  if (shape.outside) {
    plot.Shade(mean.front().x, shape_low);
    plot.Shade(shape_high, mean.back().x);
  } else if (shape.low < shape.high) {
    plot.Shade(shape_low, shape_high);
  }
  const bool has_width = bins.at.size() > 1;
  plot.Visits(counts, has_width ? x_unit.factor * (bins.at[1] - bins.at[0]) : 1);
  plot.Horizontal(0, "zero");
  if (bins.discrete) {
    for (std::size_t i = 0; i < mean.size(); ++i) plot.Line({low[i], high[i]}, "line before");
    plot.Dots(mean, "dot");
  } else {
    plot.Band(low, high, "band");
    plot.Line(mean, "line before");
  }
  return Figure(plot.Take(), fmt::format("{} {} on {} ({}). ", Escaped(error),
                                         regime.is_share ? "as a share depends" : "depends",
                                         Escaped(RegimeText(regime, diagnosed, location.channel)),
                                         Escaped(ProbabilityText(regime.p))) +
                                 Key("band", "90 % band") + Key("visited", "how often visited"));
}

std::string LeversFigure(const NextManoeuvre& next) {
  constexpr std::string_view kClasses[] = {"before", "after", "measured"};
  SvgPlot plot("levers over time", {0, next.duration_s, "Time, s"}, Widened(-1, 1, "Lever"));
  plot.Horizontal(0, "zero");
  std::string keys;
  std::size_t shown = 0;
  for (std::size_t c = 0; c < next.commands.columns.size(); ++c) {
    std::vector<PlotPoint> line;
    double last = 0;
    for (std::size_t r = 0; r < next.commands.rows.size(); ++r) {
      const double t_s = ToSeconds(next.commands.t_ns[r]), lever = next.commands.rows[r][c];
      if (lever == last) continue;
      line.push_back({t_s, last});
      line.push_back({t_s, lever});
      last = lever;
    }
    if (line.empty()) continue;
    const std::string_view css_class = kClasses[shown++ % std::size(kClasses)];
    plot.Line(line, fmt::format("line {}", css_class));
    keys += Key(css_class, Escaped(next.commands.columns[c]));
  }
  return Figure(plot.Take(), keys);
}

std::string GroundFigure(const GroundMap& map) {
  if (map.regions.empty()) return "";
  constexpr int kMost = std::numeric_limits<int>::max();
  int low_i = kMost, high_i = -kMost, low_j = kMost, high_j = -kMost;
  double greatest_m = 0;
  for (const auto& [place, cell] : map.cells) {
    low_i = std::min(low_i, place.first);
    high_i = std::max(high_i, place.first + 1);
    low_j = std::min(low_j, place.second);
    high_j = std::max(high_j, place.second + 1);
    if (cell.region >= 0) greatest_m = std::max(greatest_m, std::abs(cell.above_m));
  }
  const auto at = [&](int i, int j) { return PlotPoint{map.cell_m * i, map.cell_m * j}; };
  const PlotPoint low = at(low_i, low_j), high = at(high_i, high_j);
  const double scale = kLongestSide / std::max(high.x - low.x, high.y - low.y);
  SvgPlot plot = SvgPlot::OfArea("measured ground against simulated ground",
                                 {low.x, high.x, "East, m"}, {low.y, high.y, "North, m"}, scale);
  const auto shade = [&](const GroundCell& cell) {
    return std::lround(kShades * std::clamp(cell.above_m / greatest_m, -1.0, 1.0));
  };
  for (auto run = map.cells.begin(); run != map.cells.end();) {  // neighbours with the same colour
    const auto [i, j] = run->first;
    const long of_run = shade(run->second);
    auto next = std::next(run);
    int end_j = j + 1;
    for (; next != map.cells.end() && next->first == std::pair(i, end_j); ++next, ++end_j) {
      if (shade(next->second) != of_run) break;
    }
    const double opacity = of_run == 0 ? 1 : std::abs(static_cast<double>(of_run)) / kShades;
    plot.Rectangle(at(i, j), at(i + 1, end_j),
                   of_run == 0  ? "level"
                   : of_run > 0 ? "higher"
                                : "lower",
                   opacity);
    run = next;
  }
  for (const GroundRegion& region : map.regions) {
    plot.Rectangle({region.low_W_m.x(), region.low_W_m.y()},
                   {region.high_W_m.x(), region.high_W_m.y()}, "frame");
  }
  return Figure(
      plot.Take(),
      fmt::format("Measured ground over simulated ground, in squares of {:g} m: {}{}, full colour "
                  "at {} m; blank where no ray came down.",
                  map.cell_m, Key("higher", "higher"), Key("lower", "lower"),
                  Significant(greatest_m, 2)));
}

}  // namespace tera
