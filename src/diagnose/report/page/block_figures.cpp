#include "diagnose/report/page/block_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "diagnose/report/page/svg_plot.h"
#include "diagnose/report/text/proposal_text.h"
#include "diagnose/report/text/sentence.h"
#include "diagnose/report/text/wording.h"

namespace tera {
namespace {

constexpr std::size_t kMostPoints = 1500;  ///< of a line
/// The longest window of a figure over time, and of a small one.
constexpr double kLongestWindow_s = 30, kSmallWindow_s = 10;
constexpr std::size_t kMostBars = 12;  ///< of a figure of evidence

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

/// The envelope (EnvelopeOf) of a series at the times of the recording.
std::vector<PlotPoint> LineOf(const ReplayBlock& block, const Series& series,
                              const Segment& samples, double factor) {
  std::vector<PlotPoint> line = EnvelopeOf(series, samples, factor, kMostPoints);
  for (PlotPoint& point : line) point.x += block.time_s(0);
  return line;
}

/// The window of `length` samples within a segment that has the largest sum of squares.
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

/// The window of the prediction's figure: the worst interval with a little before and after.
Segment WindowOf(const DiagnosedBlock& diagnosed, const Location& location, double longest_s) {
  const std::size_t samples = diagnosed.block.samples();
  const Segment worst =
      location.intervals.empty() ? Segment{0, samples} : location.intervals[location.worst];
  const std::size_t margin = worst.size() / 10;
  const Segment window{worst.begin - std::min(margin, worst.begin),
                       std::min(worst.end + margin, samples)};
  const auto most = static_cast<std::size_t>(longest_s / diagnosed.block.period_s());
  return Worst(diagnosed.diagnosis.search.nothing.misfit.residual[location.channel], window,
               std::max<std::size_t>(most, 2));
}

/// The axis over the points, of which a share `outliers` may lie outside on each side.
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

/// Measured and predicted values over a window.
std::string PredictionPicture(const std::string& what, const DiagnosedBlock& diagnosed,
                              const Location& location, const Segment& window, double width) {
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
  SvgPlot plot(what, {block.time_s(window.begin), block.time_s(window.end), "Time, s"},
               RangeOf({measured, before, after}, 0, LabelWithUnit(QuantityOf(channel.name), unit)),
               width);
  plot.Horizontal(0, "zero");
  plot.Line(measured, "line measured");
  plot.Line(before, "line before");
  if (!search.found.terms.empty()) plot.Line(after, "line after");
  return plot.Take();
}

}  // namespace

std::string PredictionFigure(const DiagnosedBlock& diagnosed, const Location& location) {
  const Segment window = WindowOf(diagnosed, location, kLongestWindow_s);
  return Figure(
      PredictionPicture("measured and predicted over time", diagnosed, location, window, 900),
      Key("measured", "measured") + Key("before", "simulated as it was, nominal numbers fitted") +
          KeyOfFound(diagnosed.diagnosis.search));
}

std::string SmallPredictionFigure(const DiagnosedBlock& diagnosed, const Location& location) {
  const Segment window = WindowOf(diagnosed, location, kSmallWindow_s);
  return Figure(PredictionPicture("measured, and simulated before and after", diagnosed, location,
                                  window, 480),
                Key("measured", "measured") + Key("before", "simulated before") +
                    KeyOfFound(diagnosed.diagnosis.search));
}

std::string ErrorBars(const std::string& quantity, const HeldOutError& error,
                      const ReadableUnit& unit) {
  const auto bar = [&](const char* label, double value, std::string_view css_class) {
    return Bar{label, value, css_class, WithUnit(Significant(value * unit.factor, 2), unit)};
  };
  return Figure(SvgBars("error before and after",
                        {bar("before", error.rmse_before, "bar first"),
                         bar("after", error.rmse_after, "bar chosen")},
                        480),
                fmt::format("Error (RMS): {}", Escaped(quantity)));
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
    plot.Shade(block.time_s(interval.begin), block.time_s(interval.end), "shade");
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
  const ReadableUnit y_unit = ReadableUnitOf(regime.is_share ? "1" : channel.unit);
  const ReadableUnit x_unit = ReadableUnitOf(UnitOfVariable(regime.variable, channel.unit));
  const RegimeCurve& curve = regime.curve;
  std::vector<PlotPoint> mean, low, high, counts;
  for (Eigen::Index b = 0; b < curve.at.size(); ++b) {
    if (curve.count[b] <= 0) continue;
    const double x = x_unit.factor * curve.at[b];
    mean.push_back({x, y_unit.factor * curve.mean[b]});
    low.push_back({x, y_unit.factor * curve.low[b]});
    high.push_back({x, y_unit.factor * curve.high[b]});
    counts.push_back({x, curve.count[b]});
  }
  if (mean.empty()) return "";
  const double width =
      static_cast<double>(curve.at.size()) > 1 ? x_unit.factor * (curve.at[1] - curve.at[0]) : 1;
  SvgPlot plot(
      "error as a function of " + regime.variable,
      Widened(mean.front().x, mean.back().x,
              LabelWithUnit(VariableText(regime.variable, diagnosed.block), x_unit)),
      RangeOf({low, high, {{0, 0}}}, 0,
              LabelWithUnit(regime.is_share ? "error / simulated, less mean" : "error, less mean",
                            y_unit)),
      480, 280);
  const CurveShape& shape = regime.shape;
  if (shape.low < shape.high && !shape.outside) {
    plot.Shade(x_unit.factor * shape.low, x_unit.factor * shape.high, "shade");
  } else if (shape.outside) {
    plot.Shade(mean.front().x, x_unit.factor * shape.low, "shade");
    plot.Shade(x_unit.factor * shape.high, mean.back().x, "shade");
  }
  plot.Visits(counts, width, "visits");
  plot.Horizontal(0, "zero");
  if (curve.discrete) {
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

std::string LearnedFigure(const DiagnosedBlock& diagnosed, const Proposal& proposal) {
  const LearnedEffect& effect = proposal.learned->effect;
  const std::string& own = diagnosed.block.channels[proposal.channel].unit;
  const ReadableUnit y_unit = ReadableUnitOf(effect.is_share ? "1" : own);
  const ReadableUnit x_unit = ReadableUnitOf(effect.variable.unit);
  std::vector<PlotPoint> mean, low, high;
  for (std::size_t k = 0; k < effect.at.size(); ++k) {
    const double x = x_unit.factor * effect.at[k];
    mean.push_back({x, y_unit.factor * effect.value[k]});
    low.push_back({x, y_unit.factor * effect.low[k]});
    high.push_back({x, y_unit.factor * effect.high[k]});
  }
  SvgPlot plot(
      "learned as a function of " + effect.variable.name,
      Widened(mean.front().x, mean.back().x,
              LabelWithUnit(VariableText(effect.variable.name, diagnosed.block), x_unit)),
      RangeOf({low, high, {{0, 0}}}, 0,
              LabelWithUnit(effect.is_share ? "share of the rate" : "added to the rate", y_unit)),
      480, 280);
  plot.Horizontal(0, "zero");
  plot.Band(low, high, "band");
  plot.Line(mean, "line before");
  return Figure(plot.Take(),
                Escaped(LearnedText(diagnosed.block, proposal)) + " " + Key("band", "90 % band"));
}

/// A candidate's name, with its target where another candidate has the same name.
std::string NameAmong(const std::vector<SingleEvidence>& singles, const Candidate& candidate) {
  const auto same = std::count_if(singles.begin(), singles.end(), [&](const SingleEvidence& one) {
    return one.candidate->mechanism == candidate.mechanism;
  });
  const std::string name = Spaced(candidate.mechanism->id);
  return same == 1 ? name : name + ", " + Spaced(candidate.target);
}

std::string EvidenceFigure(const DiagnosedBlock& diagnosed) {
  const SearchResult& search = diagnosed.diagnosis.search;
  std::vector<SingleEvidence> singles = search.singles;
  std::stable_sort(singles.begin(), singles.end(),
                   [](const auto& a, const auto& b) { return a.held_out_gain > b.held_out_gain; });
  if (singles.size() > kMostBars) singles.resize(kMostBars);
  std::vector<Bar> bars;
  for (const SingleEvidence& single : singles) {
    const bool is_found =
        std::any_of(search.found.terms.begin(), search.found.terms.end(),
                    [&](const Term& term) { return term.candidate == single.candidate; });
    bars.push_back({NameAmong(singles, *single.candidate), single.held_out_gain,
                    is_found ? "bar chosen" : "bar"});
  }
  if (search.found.terms.size() > 1 && search.found_gain) {
    bars.insert(bars.begin(), {"all found, together", *search.found_gain, "bar chosen"});
  }
  bars.push_back({"flexible regressor", search.flexible_gain, "bar flexible"});
  return Figure(
      SvgBars("gain in log-likelihood of mechanisms", bars),
      "Gain in log-likelihood on held-out manoeuvres, of each mechanism alone. Of several "
      "that act, one alone may gain nothing. " +
          Key("chosen", "found") + Key("flexible", "what a flexible regressor gains"));
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

}  // namespace tera
