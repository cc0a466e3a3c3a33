#include "dataset/overview/contact_sheet.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/check.h"

namespace tera {
namespace {

constexpr int kMargin_px = 4, kLine_px = 13;
constexpr double kTextScale = 0.36;

cv::Mat PixelsOf(Picture* picture) {
  return {picture->height_px, picture->width_px, CV_8UC3, picture->data.data()};
}

/// Shortens a line to fit the width.
std::string Cut(std::string line, int width_px) {
  const auto fits = [&] {
    return cv::getTextSize(line, cv::FONT_HERSHEY_SIMPLEX, kTextScale, 1, nullptr).width <=
           width_px;
  };
  if (fits()) return line;
  do line.pop_back();
  while (!line.empty() && !fits());
  return line;
}

void WriteLines(const SheetTile& tile, int x_px, int y_px, Picture* sheet) {
  cv::Mat view = PixelsOf(sheet);
  for (const std::string& line : tile.lines) {
    y_px += kLine_px;
    cv::putText(view, Cut(line, tile.picture.width_px - 2), {x_px + 1, y_px - 3},
                cv::FONT_HERSHEY_SIMPLEX, kTextScale, cv::Scalar(225, 225, 225), 1, cv::LINE_AA);
  }
}

}  // namespace

Picture ContactSheet(const std::vector<SheetTile>& tiles) {
  TERA_CHECK(!tiles.empty());
  const int width_px = tiles.front().picture.width_px, height_px = tiles.front().picture.height_px;
  std::size_t most_lines = 0;
  for (const SheetTile& tile : tiles) {
    TERA_CHECK(tile.picture.width_px == width_px && tile.picture.height_px == height_px,
               tile.picture.width_px, tile.picture.height_px);
    most_lines = std::max(most_lines, tile.lines.size());
  }
  const int step_x_px = width_px + kMargin_px;
  const int step_y_px = height_px + kMargin_px + kLine_px * static_cast<int>(most_lines);
  const int count = static_cast<int>(tiles.size());
  const double even = std::sqrt(static_cast<double>(count) * step_y_px / step_x_px);
  const int columns = std::clamp(static_cast<int>(std::lround(even)), 1, count);
  const int rows = (count + columns - 1) / columns;
  Picture sheet(columns * step_x_px + kMargin_px, rows * step_y_px + kMargin_px, 3);
  std::fill(sheet.data.begin(), sheet.data.end(), std::uint8_t{24});
  for (int k = 0; k < count; ++k) {
    const SheetTile& tile = tiles[static_cast<std::size_t>(k)];
    const int x_px = kMargin_px + k % columns * step_x_px;
    const int y_px = kMargin_px + k / columns * step_y_px;
    Paste(tile.picture, x_px, y_px, &sheet);
    WriteText(tile.title, x_px + 5, y_px + 18, &sheet);
    WriteLines(tile, x_px, y_px + height_px, &sheet);
  }
  return sheet;
}

}  // namespace tera
