#include "layout/report/polar_drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <sstream>

#include "core/units.h"
#include "dataset/overview/picture.h"
#include "layout/report/words.h"

namespace tera {
namespace {

constexpr std::array<std::uint8_t, 3> kNothing = {205, 208, 212}, kPaper = {255, 255, 255},
                                      kNotAtAll = {72, 78, 86};
constexpr double kRadius = 185, kMiddle = 230;         ///< figure geometry, in its own units
constexpr double kLabelled_m = 6, kLabelled_deg = 30;  ///< between drawn rings and directions

/// Drawing position of a direction and a distance from the centre. Ahead is up, left is left.
struct At {
  double x, y;
};
At PlaceOf(double azimuth_rad, double radius) {
  return {kMiddle - radius * std::sin(azimuth_rad), kMiddle - radius * std::cos(azimuth_rad)};
}

double ShareOf(const PolarMap& map, double value) {
  if (map.ticks.size() < 2) return std::clamp((value - map.low) / (map.high - map.low), 0.0, 1.0);
  const auto steps = static_cast<double>(map.ticks.size() - 1);
  for (std::size_t i = 1; i < map.ticks.size(); ++i) {
    const double from = map.ticks[i - 1], to = map.ticks[i];
    if (value <= to) {
      return (static_cast<double>(i - 1) + std::max(0.0, (value - from) / (to - from))) / steps;
    }
  }
  return 1;
}

std::array<std::uint8_t, 3> ColourIn(const PolarMap& map, double value) {
  if (value < 0) return kNothing;
  if (!map.ticks.empty() && value <= map.low) return kNotAtAll;
  constexpr double kShades = 20;
  return ColourOf(std::round(kShades * ShareOf(map, value)) / kShades);
}

std::string Hex(const std::array<std::uint8_t, 3>& rgb) {
  return fmt::format("#{:02x}{:02x}{:02x}", rgb[0], rgb[1], rgb[2]);
}

/// A cell of a ring as an SVG path.
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
    const At at = PlaceOf(0.5 * kPi * static_cast<double>(i), kRadius + (i % 2 == 0 ? 11 : 4));
    constexpr std::array<const char*, 4> kAnchors = {"middle", "end", "middle", "start"};
    svg += fmt::format(
        "<text class=\"direction\" text-anchor=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>",
        kAnchors[i], at.x, at.y + 4, kNames[i]);
  }
  return svg;
}

std::string Opening(const std::string& title) {
  return fmt::format("<svg viewBox=\"0 0 {0} {0}\" role=\"img\" aria-label=\"{1}\">", 2 * kMiddle,
                     Escaped(title));
}

/// Neighbouring cells of equal colour along a ring form one path.
std::string Cells(const PolarMap& map) {
  const double sector_rad = 2 * kPi / map.sectors, ring = kRadius / map.rings;
  const auto colour = [&](int sector, int r) {
    const double value = map.value[static_cast<std::size_t>(sector) * map.rings + r];
    return Hex(ColourIn(map, value));
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

/// A closed curve around the centre, as SVG path data.
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

/// Breaks a text at spaces into lines of at most `letters`.
std::vector<std::string> Wrapped(const std::string& text, std::size_t letters) {
  std::vector<std::string> lines = {""};
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (!lines.back().empty() && lines.back().size() + 1 + word.size() > letters) {
      lines.emplace_back();
    }
    lines.back() += (lines.back().empty() ? "" : " ") + word;
  }
  return lines;
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
        rgb = ColourIn(map, value);
      }
      std::copy(rgb.begin(), rgb.end(), std::back_inserter(picture.data));
    }
  }
  return picture;
}

Image<std::uint8_t> DrawMapWithWords(const PolarMap& map, int size_px) {
  constexpr int kLine_px = 18, kTitle_px = 3 * kLine_px, kScale_px = 3 * kLine_px, kLetter_px = 9;
  Picture sheet(size_px, kTitle_px + size_px + kScale_px, 3);
  std::fill(sheet.data.begin(), sheet.data.end(), std::uint8_t{255});
  Paste(DrawMap(map, size_px), 0, kTitle_px, &sheet);
  int y_px = kLine_px;
  for (const std::string& line :
       Wrapped(map.title, static_cast<std::size_t>(size_px / kLetter_px))) {
    WriteText(line, 6, y_px, &sheet);
    y_px += kLine_px;
  }
  const int middle_px = size_px / 2, down_px = kTitle_px + size_px;
  WriteText("ahead", middle_px - 22, kTitle_px + kLine_px, &sheet);
  WriteText("behind", middle_px - 26, down_px - 8, &sheet);
  WriteText("left", 6, kTitle_px + middle_px, &sheet);
  WriteText("right", size_px - 46, kTitle_px + middle_px, &sheet);
  WriteText(fmt::format("to {:.0f} {}", map.rings * map.ring_m, map.ring_unit), size_px - 90,
            down_px - 8, &sheet);
  for (int x = 0; x < size_px; ++x) {
    const auto rgb = ColourOf(static_cast<double>(x) / size_px);
    for (int y = down_px + 4; y < down_px + kLine_px; ++y) {
      std::copy(rgb.begin(), rgb.end(), sheet.data.begin() + 3 * (y * size_px + x));
    }
  }
  const std::vector<double> ticks = TicksOf(map);
  for (std::size_t i = 0; i < ticks.size(); ++i) {
    const auto share = static_cast<double>(i) / static_cast<double>(ticks.size() - 1);
    WriteText(fmt::format("{:.4g}", ticks[i]), 4 + static_cast<int>(share * (size_px - 48)),
              down_px + 2 * kLine_px, &sheet);
  }
  return sheet;
}

std::string MapSvg(const PolarMap& map, const std::vector<double>& outline) {
  const double most = map.rings * map.ring_m;
  std::string svg = Opening(map.title) + Cells(map);
  if (!outline.empty()) {
    svg += fmt::format("<path class=\"rim\" d=\"{0}\"/><path class=\"machine\" d=\"{0}\"/>",
                       Outline(outline, most));
  }
  return svg + Frame(most, map.ring_unit) + "</svg>";
}

std::vector<double> TicksOf(const PolarMap& map) {
  return map.ticks.empty() ? std::vector{map.low, map.high} : map.ticks;
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
