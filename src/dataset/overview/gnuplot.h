#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tera {

struct Curve {
  std::string title;
  std::vector<double> x, y;
};

struct Chart {
  std::string title, x_label, y_label;
  bool equal_axes = false;  ///< x and y have equal scales
  std::vector<Curve> curves;
};

/// Draws charts with the program gnuplot, in a grid with `columns` columns, as one PNG. Throws
/// InputError if gnuplot is not installed or fails, or if the file cannot be written; no partial
/// file remains.
void DrawCharts(const std::vector<Chart>& charts, int columns, int width_px, int height_px,
                const std::filesystem::path& png);

}  // namespace tera
