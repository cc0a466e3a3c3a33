#include "diagnose/report/page/svg_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tera {
namespace {

constexpr double kLeft = 64, kRight = 12, kTop = 10, kBottom = 46;
constexpr double kLineBreak = std::numeric_limits<double>::quiet_NaN();

/// Distance of ticks: 1, 2 or 5 times a power of ten.
double TickStep(double span, int wanted) {
  const double rough = span / wanted;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= rough) return factor * power;
  }
  return 10 * power;
}

/// Label of a tick, with just enough decimals to distinguish it from the next.
std::string TickText(double value, double step) {
  if (std::abs(value) >= 1e6 || step < 1e-5) return fmt::format("{:.3g}", value);
  const int decimals = std::max(0, static_cast<int>(std::ceil(-std::log10(step) - 1e-9)));
  return fmt::format("{:.{}f}", std::abs(value) < 1e-9 * step ? 0.0 : value, decimals);
}

std::string Text(double x, double y, std::string_view anchor, std::string_view css_class,
                 std::string_view text) {
  return fmt::format("<text x='{:.1f}' y='{:.1f}' text-anchor='{}' class='{}'>{}</text>", x, y,
                     anchor, css_class, Escaped(text));
}

bool IsFinite(const PlotPoint& point) { return std::isfinite(point.x) && std::isfinite(point.y); }

}  // namespace

PlotAxis Widened(double low, double high, std::string label) {
  if (!(low <= high) || !std::isfinite(low) || !std::isfinite(high)) low = high = 0;
  double margin = 0.05 * (high - low);
  if (margin <= 0) margin = low == 0 ? 1 : 0.05 * std::abs(low);
  // Ticks are counted in doubles, which do not increase by 1 beyond 2^53.
  margin = std::max(margin, 1e-9 * std::max(std::abs(low), std::abs(high)));
  return {low - margin, high + margin, std::move(label)};
}

std::vector<double> TicksOf(const PlotAxis& axis, int wanted) {
  const double step = TickStep(axis.high - axis.low, wanted);
  std::vector<double> ticks;
  const double first = std::ceil(axis.low / step - 1e-9);
  for (double k = first; k * step <= axis.high + 1e-9 * step; ++k) ticks.push_back(k * step);
  return ticks;
}

SvgPlot::SvgPlot(const std::string& what, PlotAxis x, PlotAxis y, double width, double height)
    : what_(what), x_(std::move(x)), y_(std::move(y)), width_(width), height_(height) {}

SvgPlot SvgPlot::OfArea(const std::string& what, PlotAxis x, PlotAxis y, double scale) {
  const double width = kLeft + scale * (x.high - x.low) + kRight;
  const double height = kTop + scale * (y.high - y.low) + kBottom;
  return {what, std::move(x), std::move(y), width, height};
}

double SvgPlot::X(double x) const {
  return kLeft + (width_ - kLeft - kRight) * (x - x_.low) / (x_.high - x_.low);
}

double SvgPlot::Y(double y) const {
  return height_ - kBottom - (height_ - kTop - kBottom) * (y - y_.low) / (y_.high - y_.low);
}

void SvgPlot::Rectangle(const PlotPoint& low, const PlotPoint& high, std::string_view css_class,
                        double opacity) {
  inside_ += fmt::format(
      "<rect class='{}' x='{:.1f}' y='{:.1f}' width='{:.1f}' height='{:.1f}' "
      "fill-opacity='{:.2g}'/>",
      css_class, X(low.x), Y(high.y), std::max(X(high.x) - X(low.x), 1.0), Y(low.y) - Y(high.y),
      opacity);
}

void SvgPlot::Shade(double x_low, double x_high) {
  Rectangle({x_low, y_.low}, {x_high, y_.high}, "shade");
}

void SvgPlot::Horizontal(double y, std::string_view css_class) {
  Line({{x_.low, y}, {x_.high, y}}, css_class);
}

void SvgPlot::Line(const std::vector<PlotPoint>& points, std::string_view css_class) {
  std::string path;
  bool pen_down = false;
  for (const PlotPoint& point : points) {
    if (!IsFinite(point)) {
      pen_down = false;
      continue;
    }
    path += fmt::format("{}{:.1f} {:.1f}", pen_down ? 'L' : 'M', X(point.x), Y(point.y));
    pen_down = true;
  }
  if (!path.empty()) inside_ += fmt::format("<path class='{}' d='{}'/>", css_class, path);
}

void SvgPlot::Band(const std::vector<PlotPoint>& low, const std::vector<PlotPoint>& high,
                   std::string_view css_class) {
  std::string corners;
  const auto add = [&](const PlotPoint& point) {
    if (IsFinite(point)) corners += fmt::format("{:.1f},{:.1f} ", X(point.x), Y(point.y));
  };
  std::for_each(low.begin(), low.end(), add);
  std::for_each(high.rbegin(), high.rend(), add);
  if (!corners.empty()) {
    inside_ += fmt::format("<polygon class='{}' points='{}'/>", css_class, corners);
  }
}

void SvgPlot::Dots(const std::vector<PlotPoint>& points, std::string_view css_class) {
  for (const PlotPoint& point : points) {
    if (!IsFinite(point)) continue;
    inside_ += fmt::format("<circle class='{}' cx='{:.1f}' cy='{:.1f}' r='3.5'/>", css_class,
                           X(point.x), Y(point.y));
  }
}

void SvgPlot::Visits(const std::vector<PlotPoint>& counts, double width_x) {
  double most = 0;
  for (const PlotPoint& count : counts) most = std::max(most, count.y);
  if (most <= 0) return;
  for (const PlotPoint& count : counts) {
    const double top = y_.low + 0.1 * (y_.high - y_.low) * count.y / most;
    Rectangle({count.x - 0.5 * width_x, y_.low}, {count.x + 0.5 * width_x, top}, "visits");
  }
}

std::string SvgPlot::Axes() const {
  const double bottom = height_ - kBottom, right = width_ - kRight;
  std::string text;
  const int x_ticks = width_ > 600 ? 10 : 6;
  const double x_step = TickStep(x_.high - x_.low, x_ticks);
  for (const double tick : TicksOf(x_, x_ticks)) {
    text += fmt::format("<path class='tick' d='M{0:.1f} {1:.1f}v5'/>", X(tick), bottom);
    text += Text(X(tick), bottom + 18, "middle", "number", TickText(tick, x_step));
  }
  for (const double tick : TicksOf(y_, 5)) {
    text += fmt::format("<path class='grid' d='M{:.1f} {:.1f}H{:.1f}'/>", kLeft, Y(tick), right);
    text += Text(kLeft - 8, Y(tick) + 4, "end", "number",
                 TickText(tick, TickStep(y_.high - y_.low, 5)));
  }
  text += Text(0.5 * (kLeft + right), height_ - 8, "middle", "axis", x_.label);
  text += fmt::format(
      "<text class='axis' text-anchor='middle' transform='translate(14 {:.1f}) "
      "rotate(-90)'>{}</text>",
      0.5 * (kTop + bottom), Escaped(y_.label));
  return text;
}

std::string SvgPlot::Take() const {
  const double width = width_ - kLeft - kRight, height = height_ - kTop - kBottom;
  // A nested SVG clips shapes beyond its edges.
  return fmt::format("<svg viewBox='0 0 {0:.0f} {1:.0f}' role='img' aria-label='{2}'>", width_,
                     height_, Escaped(what_)) +
         Axes() +
         fmt::format("<svg x='{0}' y='{1}' width='{2}' height='{3}' viewBox='{0} {1} {2} {3}'>",
                     kLeft, kTop, width, height) +
         inside_ + "</svg>" +
         fmt::format("<path class='frame' d='M{:.1f} {:.1f}H{:.1f}'/></svg>", kLeft,
                     height_ - kBottom, width_ - kRight);
}

std::vector<PlotPoint> EnvelopeOf(const Series& series, const Segment& samples, double factor,
                                  std::size_t most) {
  const std::size_t end = std::min(samples.end, series.size());
  const std::size_t count = end > samples.begin ? end - samples.begin : 0;
  const std::size_t bin = count <= most ? 1 : (2 * count + most - 1) / most;
  const auto point = [&](std::size_t k) {
    return PlotPoint{static_cast<double>(k) * series.period_s, factor * series.value[k]};
  };
  std::vector<PlotPoint> line;
  for (std::size_t begin = samples.begin; begin < end; begin += bin) {
    std::size_t lowest = end, highest = end;
    for (std::size_t k = begin; k < std::min(begin + bin, end); ++k) {
      if (!series.valid[k]) continue;
      if (lowest == end || series.value[k] < series.value[lowest]) lowest = k;
      if (highest == end || series.value[k] > series.value[highest]) highest = k;
    }
    if (lowest == end) {
      if (!line.empty() && std::isfinite(line.back().y)) line.push_back({kLineBreak, kLineBreak});
      continue;
    }
    line.push_back(point(std::min(lowest, highest)));
    if (lowest != highest) line.push_back(point(std::max(lowest, highest)));
  }
  return line;
}

}  // namespace tera
