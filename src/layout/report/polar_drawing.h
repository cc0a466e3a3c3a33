#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/types/measurement.h"
#include "layout/measures/polar_map.h"

namespace tera {

/// A map as a picture, ahead up, on white; cells without a value are grey. `size_px` to a side.
Image<std::uint8_t> DrawMap(const PolarMap& map, int size_px);

/// The same below its title, with the directions and, below, what the colours mean.
Image<std::uint8_t> DrawMapWithWords(const PolarMap& map, int size_px);

/// A map as SVG, with rings every 6 m and directions; to stand in a page. `outline` is drawn over
/// it: that of the machine, in the map's unit, by direction; empty: none.
std::string MapSvg(const PolarMap& map, const std::vector<double>& outline = {});

/// Values at even steps of a map's colours.
std::vector<double> TicksOf(const PolarMap& map);

/// Curves over the directions as SVG: of each the mean as a line, and the area of what holds at the
/// worst moment.
/// `css_classes` one for each.
std::string CurvesSvg(const std::string& title, double most, const std::vector<PolarCurve>& curves,
                      const std::vector<std::string>& css_classes);

/// Colour of a value, 0 to 1, in sRGB: from dark red, which is bad, by white to blue.
std::array<std::uint8_t, 3> ColourOf(double share);

}  // namespace tera
