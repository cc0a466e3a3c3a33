#include "dataset/overview/gnuplot.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>

#include "core/check.h"
#include "dataset/files/checked_file.h"
#include "dataset/files/child_process.h"

namespace tera {
namespace {

constexpr const char* kColours[] = {"#1f5fa8", "#d9541e", "#2e8b57",
                                    "#8a3ea8", "#c29a00", "#333333"};
constexpr std::size_t kColourCount = std::size(kColours);

/// A single-quoted gnuplot string, in which a quote is doubled.
std::string Quoted(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? "''" : std::string(1, c);
  return quoted + "'";
}

struct Span {
  double low = std::numeric_limits<double>::infinity(), high = -low;
};

Span SpanOf(const std::vector<Curve>& curves, std::vector<double> Curve::*axis) {
  Span span;
  for (const Curve& curve : curves) {
    for (const double v : curve.*axis) span = {std::min(span.low, v), std::max(span.high, v)};
  }
  return span;
}

/// The automatic range of gnuplot; or, if `span` is shorter than `least`, a range of length `least`
/// about its middle.
std::string AxisRange(const Span& span, double least) {
  if (span.high - span.low >= least) return "[*:*]";
  const double middle = 0.5 * (span.low + span.high);
  return fmt::format("[{}:{}]", middle - 0.5 * least, middle + 0.5 * least);
}

/// Ranges of both axes. A constant curve and the path of a machine at rest, or along one axis, need
/// a minimum range.
std::string Ranges(const Chart& chart) {
  constexpr double kLeastOfWider = 0.1, kLeastPath_m = 0.2, kLeast = 1e-12;
  const Span x = SpanOf(chart.curves, &Curve::x), y = SpanOf(chart.curves, &Curve::y);
  if (x.low > x.high) return "set xrange [*:*]\nset yrange [*:*]\n";
  if (!chart.equal_axes) {
    const bool constant = y.high - y.low < kLeast;
    return fmt::format("set xrange [*:*]\nset yrange {}\n", AxisRange(y, constant ? 2.0 : 0.0));
  }
  const double least =
      std::max(kLeastPath_m, kLeastOfWider * std::max(x.high - x.low, y.high - y.low));
  return fmt::format("set xrange {}\nset yrange {}\n", AxisRange(x, least), AxisRange(y, least));
}

void AppendChart(const Chart& chart, std::string* script) {
  const auto out = std::back_inserter(*script);
  fmt::format_to(out,
                 "set title {} noenhanced\nset xlabel {} noenhanced\nset ylabel {} noenhanced\n",
                 Quoted(chart.title), Quoted(chart.x_label), Quoted(chart.y_label));
  // Axis labels are rotated to fit a short axis of a path.
  *script += chart.equal_axes ? "set size ratio -1\nset xtics rotate\n"
                              : "set size noratio\nset xtics norotate\n";
  *script += Ranges(chart);
  bool any = false;
  std::string plot, data;
  for (std::size_t i = 0; i < chart.curves.size(); ++i) {
    const Curve& curve = chart.curves[i];
    TERA_CHECK(curve.x.size() == curve.y.size(), curve.x.size(), curve.y.size());
    if (curve.x.empty()) continue;
    fmt::format_to(std::back_inserter(plot),
                   "{}'-' with lines lw 1.5 lc rgb '{}' title {} noenhanced", any ? ", " : "plot ",
                   kColours[i % kColourCount], Quoted(curve.title));
    for (std::size_t k = 0; k < curve.x.size(); ++k) {
      fmt::format_to(std::back_inserter(data), "{} {}\n", curve.x[k], curve.y[k]);
    }
    data += "e\n";
    any = true;
  }
  // A chart without data leaves its cell of the grid empty.
  *script += any ? plot + "\n" + data : "set multiplot next\n";
}

}  // namespace

void DrawCharts(const std::vector<Chart>& charts, int columns, int width_px, int height_px,
                const std::filesystem::path& png) {
  TERA_CHECK(columns > 0 && !charts.empty(), columns, charts.size());
  CheckedFile picture(png);
  const int rows = (static_cast<int>(charts.size()) + columns - 1) / columns;
  std::string script = fmt::format(
      "set terminal pngcairo size {},{} font 'sans,10'\nset output {}\nset grid lc rgb '#dddddd'\n"
      "set key below samplen 1\nset multiplot layout {},{}\n",
      width_px, height_px, Quoted(picture.temporary().string()), rows, columns);
  for (const Chart& chart : charts) AppendChart(chart, &script);
  script += "unset multiplot\n";
  ChildProcess gnuplot(
      "gnuplot", "2>/dev/null",
      fmt::format("need gnuplot with the pngcairo terminal (Debian package gnuplot-nox), and space "
                  "on the disk for {}",
                  png.string()));
  gnuplot.Write(script);
  gnuplot.Close();
  picture.Commit();
}

}  // namespace tera
