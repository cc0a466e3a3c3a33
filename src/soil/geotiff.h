#pragma once

#include <filesystem>
#include <vector>

#include "soil/soil.h"

namespace tera {

/// Heights of a site, row-major with x fastest and y northwards, as they stand in a file.
struct ElevationGrid {
  int nx = 0, ny = 0;
  double cell_x_m = 0, cell_y_m = 0;
  std::vector<double> height_m;  ///< about the height of the grid's middle
  SiteOrigin origin;             ///< the grid's middle

  double width_m() const { return (nx - 1) * cell_x_m; }
  double depth_m() const { return (ny - 1) * cell_y_m; }
  /// Bilinear height at (x, y) metres from the middle, east and north.
  double HeightAt(double x_m, double y_m) const;
};

/// Reads a one-band elevation GeoTIFF in a projected or geographic reference system. Throws
/// InputError if it is unreadable, has no projection, is rotated, or has gaps.
ElevationGrid ReadElevation(const std::filesystem::path& file);

/// Writes a surface as float32 metres above `origin`'s height, in a transverse Mercator projection
/// whose origin is `origin`. Throws InputError where the file cannot be written.
void WriteElevation(const std::filesystem::path& file, const TerrainSurface& surface,
                    const SiteOrigin& origin);

}  // namespace tera
