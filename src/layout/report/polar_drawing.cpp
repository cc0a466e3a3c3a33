#include "layout/report/polar_drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/units.h"
#include "layout/report/words.h"

namespace tera {
namespace {

constexpr std::array<std::uint8_t, 3> kNothing = {205, 208, 212}, kPaper = {255, 255, 255};
constexpr double kRadius = 185, kMiddle = 230;         ///< of a figure, in its own units
constexpr double kLabelled_m = 6, kLabelled_deg = 30;  ///< between rings that are drawn

/// Where a direction and a distance from the middle lie in a figure: ahead is up, left is left.
struct At {
  double x, y;
};
At PlaceOf(double azimuth_rad, double radius) {
  return {kMiddle - radius * std::sin(azimuth_rad), kMiddle - radius * std::cos(azimuth_rad)};
}

double ShareOf(const PolarMap& map, double value) {
  return std::clamp((value - map.low) / (map.high - map.low), 0.0, 1.0);
}

std::string Hex(const std::array<std::uint8_t, 3>& rgb) {
  return fmt::format("#{:02x}{:02x}{:02x}", rgb[0], rgb[1], rgb[2]);
}

/// A part of a ring as a path.
std::string RingPart(double low, double high, double from_rad, double to_rad) {
  const At a = PlaceOf(from_rad, high), b = PlaceOf(to_rad, high), c = PlaceOf(to_rad, low),
           d = PlaceOf(from_rad, low);
  const int large = to_rad - from_rad > kPi;
  return fmt::format(
      "M{:.1f} {:.1f}A{:.1f} {:.1f} 0 {} 0 {:.1f} {:.1f}L{:.1f} {:.1f}"
      "A{:.1f} {:.1f} 0 {} 1 {:.1f} {:.1f}Z",
      a.x, a.y, high, high, large, b.x, b.y, c.x, c.y, low, low, large, d.x, d.y);
}

/// Rings with their distances, and the directions.
std::string Frame(double most, const std::string& unit) {
  const double step = unit == "m" ? kLabelled_m : kLabelled_deg;
  std::string svg;
  for (double at = step; at <= most + 1e-9; at += step) {
    const double r = kRadius * at / most;
    svg += fmt::format(
        "<circle class=\"grid\" cx=\"{}\" cy=\"{}\" r=\"{:.1f}\"/>"
        "<text x=\"{:.1f}\" y=\"{:.1f}\">{:.0f} {}</text>",
        kMiddle, kMiddle, r, kMiddle + 3, kMiddle - r + 13, at, unit);
  }
  constexpr std::array<const char*, 4> kNames = {"ahead", "left", "behind", "right"};
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    const At at = PlaceOf(0.5 * kPi * static_cast<double>(i), kRadius + 11);
    svg += fmt::format("<text class=\"direction\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>", at.x,
                       at.y + 4, kNames[i]);
  }
  return svg;
}

std::string Opening(const std::string& title) {
  return fmt::format("<svg viewBox=\"0 0 {0} {0}\" role=\"img\" aria-label=\"{1}\">", 2 * kMiddle,
                     Escape(title));
}

/// Cells of equal colour beside each other along a ring are one path.
std::string Cells(const PolarMap& map) {
  const double sector_rad = 2 * kPi / map.sectors, ring = kRadius / map.rings;
  const auto colour = [&](int sector, int r) {
    const double value = map.value[static_cast<std::size_t>(sector) * map.rings + r];
    return value < 0 ? Hex(kNothing) : Hex(ColourOf(std::round(20 * ShareOf(map, value)) / 20));
  };
  std::string svg;
  for (int r = 0; r < map.rings; ++r) {
    for (int from = 0; from < map.sectors;) {
      int to = from + 1;
      while (to < map.sectors && to - from < map.sectors / 3 && colour(to, r) == colour(from, r)) {
        ++to;
      }
      svg += fmt::format(
          "<path fill=\"{0}\" stroke=\"{0}\" d=\"{1}\"/>", colour(from, r),
          RingPart(ring * r, ring * (r + 1), (from - 0.5) * sector_rad, (to - 0.5) * sector_rad));
      from = to;
    }
  }
  return svg;
}

/// A closed line around the middle, as a part of a path.
std::string Outline(const std::vector<double>& radius_m, double most) {
  std::string path;
  for (std::size_t i = 0; i < radius_m.size(); ++i) {
    const double azimuth_rad =
        2 * kPi * static_cast<double>(i) / static_cast<double>(radius_m.size());
    const At at = PlaceOf(azimuth_rad, kRadius * std::min(1.0, radius_m[i] / most));
    path += fmt::format("{}{:.1f} {:.1f}", i == 0 ? "M" : "L", at.x, at.y);
  }
  return path.empty() ? path : path + "Z";
}

}  // namespace

std::array<std::uint8_t, 3> ColourOf(double share) {
  constexpr std::array<std::array<double, 3>, 5> kStops = {
      {{122, 22, 34}, {214, 110, 78}, {245, 236, 225}, {126, 178, 214}, {24, 82, 138}}};
  const double at = std::clamp(share, 0.0, 1.0) * (kStops.size() - 1);
  const auto i = std::min<std::size_t>(static_cast<std::size_t>(at), kStops.size() - 2);
  std::array<std::uint8_t, 3> rgb;
  for (std::size_t c = 0; c < 3; ++c) {
    const double s = at - static_cast<double>(i);
    rgb[c] = static_cast<std::uint8_t>(std::lround(std::lerp(kStops[i][c], kStops[i + 1][c], s)));
  }
  return rgb;
}

Image<std::uint8_t> DrawMap(const PolarMap& map, int size_px) {
  Image<std::uint8_t> picture;
  picture.width_px = picture.height_px = size_px;
  picture.channels = 3;
  const double middle_px = 0.5 * (size_px - 1), radius_px = 0.48 * size_px;
  for (int y = 0; y < size_px; ++y) {
    for (int x = 0; x < size_px; ++x) {
      const double ahead_px = middle_px - y, left_px = middle_px - x;
      const double share = std::hypot(ahead_px, left_px) / radius_px;
      std::array<std::uint8_t, 3> rgb = kPaper;
      if (share < 1) {
        const double sector =
            std::atan2(left_px, ahead_px) / (2 * kPi) * map.sectors + map.sectors + 0.5;
        const auto s = static_cast<std::size_t>(sector) % static_cast<std::size_t>(map.sectors);
        const auto r = static_cast<std::size_t>(share * map.rings);
        const double value = map.value[s * static_cast<std::size_t>(map.rings) + r];
        rgb = value < 0 ? kNothing : ColourOf(ShareOf(map, value));
      }
      std::copy(rgb.begin(), rgb.end(), std::back_inserter(picture.data));
    }
  }
  return picture;
}

std::string MapSvg(const PolarMap& map) {
  return Opening(map.title) + Cells(map) + Frame(map.rings * map.ring_m, map.ring_unit) + "</svg>";
}

std::string CurvesSvg(const std::string& title, double most, const std::vector<PolarCurve>& curves,
                      const std::vector<std::string>& css_classes) {
  std::string svg = Opening(title) + Frame(most, "m");
  for (std::size_t i = 0; i < curves.size(); ++i) {
    svg += fmt::format(
        "<path class=\"area {0}\" fill-rule=\"evenodd\" d=\"{1}{2}\"/>"
        "<path class=\"outline {0}\" d=\"{3}\"/>",
        css_classes[i], Outline(curves[i].worst, most), Outline(curves[i].worst_from, most),
        Outline(curves[i].mean, most));
  }
  return svg + "</svg>";
}

}  // namespace tera
