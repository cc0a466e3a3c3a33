#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/types/measurement.h"
#include "layout/measures/polar_map.h"

namespace tera {

/// Draws a map as a square picture with `size_px` pixels per side, ahead up, on white. Cells
/// without a value are grey.
Image<std::uint8_t> DrawMap(const PolarMap& map, int size_px);

/// As DrawMap, with title, directions and legend.
Image<std::uint8_t> DrawMapWithWords(const PolarMap& map, int size_px);

/// A map as SVG, with directions and with labelled rings every 6 m or 30 degrees. `outline` is the
/// machine's outline by direction, in the map's unit; empty: none.
std::string MapSvg(const PolarMap& map, const std::vector<double>& outline = {});

/// Values at equal steps of the colour scale.
std::vector<double> TicksOf(const PolarMap& map);

/// Curves over the directions as SVG. For each curve a line shows the mean, and an area shows the
/// range at the worst moment. `css_classes` has one class per curve; `most` is the end of the axis.
std::string CurvesSvg(const std::string& title, double most, const std::vector<PolarCurve>& curves,
                      const std::vector<std::string>& css_classes);

/// sRGB colour of a value in [0, 1]: dark red (bad), white, blue (good).
std::array<std::uint8_t, 3> ColourOf(double share);

}  // namespace tera
