#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/html.h"
#include "diagnose/statistics/series/series.h"

/// Small figures as inline SVG. Elements have CSS classes only; the page defines colours and
/// strokes.

namespace tera {

struct PlotPoint {
  double x = 0, y = 0;
};

struct PlotAxis {
  double low = 0, high = 1;
  std::string label;  ///< includes the unit
};

/// Axis with a margin of a twentieth of [low, high] on both sides. The range is never empty.
PlotAxis Widened(double low, double high, std::string label);

/// About `wanted` round values within an axis, at distances of 1, 2 or 5 times a power of ten.
std::vector<double> TicksOf(const PlotAxis& axis, int wanted);

/// A figure with two axes. Shapes outside the axes are clipped.
class SvgPlot {
 public:
  /// `what` is the figure's label for screen readers.
  SvgPlot(const std::string& what, PlotAxis x, PlotAxis y, double width = 900, double height = 260);
  /// A figure with equal scales: `scale` SVG units per unit of both axes.
  static SvgPlot OfArea(const std::string& what, PlotAxis x, PlotAxis y, double scale);

  void Rectangle(const PlotPoint& low, const PlotPoint& high, std::string_view css_class,
                 double opacity = 1);
  /// Shades an interval of x over the full height.
  void Shade(double x_low, double x_high);
  void Horizontal(double y, std::string_view css_class);
  /// A polyline, interrupted at points that are not finite.
  void Line(const std::vector<PlotPoint>& points, std::string_view css_class);
  /// The area between two curves over the same x.
  void Band(const std::vector<PlotPoint>& low, const std::vector<PlotPoint>& high,
            std::string_view css_class);
  void Dots(const std::vector<PlotPoint>& points, std::string_view css_class);
  /// Bars along the lower edge for the number of samples at each x. The longest bar has a tenth of
  /// the height.
  void Visits(const std::vector<PlotPoint>& counts, double width_x);

  std::string Take() const;

 private:
  double X(double x) const;
  double Y(double y) const;
  std::string Axes() const;

  std::string what_;
  PlotAxis x_, y_;
  double width_, height_;
  std::string inside_;
};

/// A line of at most `most` points through samples: the minimum and maximum of each bin of
/// neighbours, in their order. Gaps are points that are not finite. x is in seconds; y is
/// multiplied by `factor`.
std::vector<PlotPoint> EnvelopeOf(const Series& series, const Segment& samples, double factor,
                                  std::size_t most);

}  // namespace tera
