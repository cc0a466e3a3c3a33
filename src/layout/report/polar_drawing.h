#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/types/measurement.h"
#include "layout/measures/polar_map.h"

namespace tera {

/// A map as a picture of `size_px` squared, ahead up, on white. Cells without a value are grey.
Image<std::uint8_t> DrawMap(const PolarMap& map, int size_px);

/// The map below its title, with the directions and a legend below.
Image<std::uint8_t> DrawMapWithWords(const PolarMap& map, int size_px);

/// A map as SVG for a page, with rings every 6 m and directions. `outline` is the machine's outline
/// by direction in the map's unit; empty: none.
std::string MapSvg(const PolarMap& map, const std::vector<double>& outline = {});

/// Values at equal steps of a map's colours.
std::vector<double> TicksOf(const PolarMap& map);

/// Curves over the directions as SVG: for each the mean as a line, and the worst-moment range as an
/// area. `css_classes` has one class per curve.
std::string CurvesSvg(const std::string& title, double most, const std::vector<PolarCurve>& curves,
                      const std::vector<std::string>& css_classes);

/// Colour of a value, 0 to 1, in sRGB: from dark red (bad) by white to blue.
std::array<std::uint8_t, 3> ColourOf(double share);

}  // namespace tera
