#include "campaign/sweep/sweep_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/parse_number.h"

namespace tera {
namespace {

constexpr double kWidth = 640, kPanel = 300, kLeft = 84, kRight = 20, kTop = 28, kBottom = 46;
constexpr int kTicks = 5;
constexpr double kMargin = 0.08;  ///< margin of an axis beyond its values, as a fraction
constexpr std::size_t kMostLabels = 10;

struct Axis {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  double from = 0, to = 1;  ///< position on the page

  void Hold(double value) {
    least = std::min(least, value);
    most = std::max(most, value);
  }
  void Widen() {
    const double width = most > least ? most - least : std::max(std::abs(most), 1.0);
    least -= kMargin * width;
    most += kMargin * width;
  }
  double At(double value) const { return from + (to - from) * (value - least) / (most - least); }
};

std::string Escaped(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    escaped += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
  }
  return escaped;
}

class Panel {
 public:
  Panel(const FactorEffect& effect, std::size_t factor, const std::vector<SweptRun>& runs,
        double top)
      : effect_(effect), factor_(factor), runs_(runs), top_(top) {
    x_.from = kLeft;
    x_.to = kWidth - kRight;
    y_.from = top + kPanel - kBottom;
    y_.to = top + kTop;
    for (const LevelMean& level : effect.levels) {
      x_.Hold(PlaceOf(level.level));
      y_.Hold(level.low.value_or(level.mean));
      y_.Hold(level.high.value_or(level.mean));
    }
    for (const SweptRun& run : runs) y_.Hold(run.outcome);
    x_.Widen();
    y_.Widen();
  }

  std::string Svg(const std::string& figure) const {
    return Frame(figure) + Runs() + Line() + Means();
  }

 private:
  double PlaceOf(const std::string& level) const {
    if (effect_.is_numeric) return *ParseFinite(level);
    const auto at = std::ranges::find(effect_.levels, level, &LevelMean::level);
    return static_cast<double>(at - effect_.levels.begin());
  }

  std::string Label(double place, const std::string& text) const {
    return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>\n",
                       x_.At(place), y_.from + 18, Escaped(text));
  }

  std::string Frame(const std::string& figure) const {
    std::string svg;
    for (int k = 0; k <= kTicks; ++k) {
      const double value = y_.least + (y_.most - y_.least) * k / kTicks;
      svg += fmt::format(
          "<path d=\"M{} {:.1f}H{}\" stroke=\"#ddd\"/><text x=\"{}\" y=\"{:.1f}\" "
          "text-anchor=\"end\">{:.4g}</text>\n",
          x_.from, y_.At(value), x_.to, x_.from - 6, y_.At(value) + 4, value);
    }
    const std::size_t levels = effect_.levels.size();
    if (effect_.is_numeric && levels > kMostLabels) {
      for (int k = 0; k <= kTicks; ++k) {
        const double value = x_.least + (x_.most - x_.least) * k / kTicks;
        svg += Label(value, fmt::format("{:.4g}", value));
      }
    } else {
      const std::size_t each = (levels + kMostLabels - 1) / kMostLabels;
      for (std::size_t k = 0; k < levels; k += each) {
        const std::string& level = effect_.levels[k].level;
        svg += Label(PlaceOf(level), level);
      }
    }
    return svg + fmt::format(
                     "<text x=\"{}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>"
                     "<text x=\"{}\" y=\"{:.1f}\">{}</text>\n",
                     (x_.from + x_.to) / 2, top_ + kPanel - 8, Escaped(effect_.key), x_.from,
                     top_ + 18, Escaped(figure));
  }

  std::string Runs() const {
    std::string svg;
    for (const SweptRun& run : runs_) {
      svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\" fill=\"#999\"/>\n",
                         x_.At(PlaceOf(run.values[factor_])), y_.At(run.outcome));
    }
    return svg;
  }

  /// The least-squares line passes through the mean of all runs.
  std::string Line() const {
    if (!effect_.slope) return "";
    double x_mean = 0, y_mean = 0;
    for (const SweptRun& run : runs_) {
      x_mean += PlaceOf(run.values[factor_]) / static_cast<double>(runs_.size());
      y_mean += run.outcome / static_cast<double>(runs_.size());
    }
    const double from = PlaceOf(effect_.levels.front().level),
                 to = PlaceOf(effect_.levels.back().level);
    const auto y = [&](double x) { return y_.At(y_mean + effect_.slope->per_unit * (x - x_mean)); };
    return fmt::format("<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\" stroke=\"#06c\" fill=\"none\"/>\n",
                       x_.At(from), y(from), x_.At(to), y(to));
  }

  std::string Means() const {
    std::string svg;
    for (const LevelMean& level : effect_.levels) {
      if (!level.low) continue;
      const double x = x_.At(PlaceOf(level.level));
      svg += fmt::format(
          "<path d=\"M{0:.1f} {1:.1f}V{2:.1f}M{3:.1f} {1:.1f}h10M{3:.1f} {2:.1f}h10\" "
          "stroke=\"black\"/><circle cx=\"{0:.1f}\" cy=\"{4:.1f}\" r=\"4\"/>\n",
          x, y_.At(*level.low), y_.At(*level.high), x - 5, y_.At(level.mean));
    }
    return svg;
  }

  const FactorEffect& effect_;
  std::size_t factor_;
  const std::vector<SweptRun>& runs_;
  double top_;
  Axis x_, y_;
};

}  // namespace

std::string SweepPlot(const std::vector<FactorEffect>& effects, const std::vector<SweptRun>& runs,
                      const std::string& figure) {
  const double height = kPanel * static_cast<double>(effects.size());
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" "
      "font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"{0}\" height=\"{1}\" "
      "fill=\"white\"/>\n",
      kWidth, height);
  for (std::size_t f = 0; f < effects.size(); ++f) {
    svg += Panel(effects[f], f, runs, kPanel * static_cast<double>(f)).Svg(figure);
  }
  return svg + "</svg>\n";
}

}  // namespace tera
