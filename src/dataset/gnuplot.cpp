#include "dataset/gnuplot.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>

#include "core/check.h"
#include "dataset/child_process.h"

namespace tera {
namespace {

constexpr const char* kColours[] = {"#1f5fa8", "#d9541e", "#2e8b57",
                                    "#8a3ea8", "#c29a00", "#333333"};
constexpr std::size_t kColourCount = std::size(kColours);

/// `text` as a single-quoted string of gnuplot, where a quote is doubled.
std::string Quoted(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? "''" : std::string(1, c);
  return quoted + "'";
}

/// Range of y that gnuplot finds by itself, save for curves that are all one constant.
std::string YRange(const Chart& chart) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Curve& curve : chart.curves) {
    for (const double y : curve.y) {
      low = std::min(low, y);
      high = std::max(high, y);
    }
  }
  return low == high ? fmt::format("[{}:{}]", low - 1.0, high + 1.0) : "[*:*]";
}

void AppendChart(const Chart& chart, std::string* script) {
  const auto out = std::back_inserter(*script);
  fmt::format_to(out,
                 "set title {} noenhanced\nset xlabel {} noenhanced\nset ylabel {} noenhanced\n",
                 Quoted(chart.title), Quoted(chart.x_label), Quoted(chart.y_label));
  fmt::format_to(out, "set size {}\n", chart.equal_axes ? "ratio -1" : "noratio");
  fmt::format_to(out, "set yrange {}\n", YRange(chart));
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
  // A chart without data keeps its place in the grid.
  *script += any ? plot + "\n" + data : "set multiplot next\n";
}

}  // namespace

void DrawCharts(const std::vector<Chart>& charts, int columns, int width_px, int height_px,
                const std::filesystem::path& png) {
  TERA_CHECK(columns > 0 && !charts.empty(), columns, charts.size());
  const int rows = (static_cast<int>(charts.size()) + columns - 1) / columns;
  std::string script = fmt::format(
      "set terminal pngcairo size {},{} font 'sans,10'\nset output {}\nset grid lc rgb '#dddddd'\n"
      "set key below samplen 1\nset multiplot layout {},{}\n",
      width_px, height_px, Quoted(png.string()), rows, columns);
  for (const Chart& chart : charts) AppendChart(chart, &script);
  script += "unset multiplot\n";
  ChildProcess gnuplot("gnuplot", "",
                       fmt::format("need gnuplot with the pngcairo terminal (Debian package "
                                   "gnuplot-nox), and a folder that can be written for {}",
                                   png.string()));
  gnuplot.Write(script);
  gnuplot.Close();
}

}  // namespace tera
