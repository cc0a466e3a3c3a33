#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "soil/soil.h"

namespace tera {

/// Heights of a site, row-major with x fastest and y northwards.
///
/// Frames  the tangent plane at `origin`: x east, y north, z up, as in W.
/// Model   the file's heights, bilinear between its pixels, on a grid of the tangent plane. The
///         file's reference system gives the places, and so includes meridian convergence, scale
///         and datum. The ellipsoid's drop below the plane, x^2 / 2N + y^2 / 2M, is taken off.
///         Where the turned grid reaches over the file's border, the border's height goes on.
///         Heights in the file are taken as above the WGS 84 ellipsoid.
/// Omits   the geoid, so that heights above sea level shift the whole site by the geoid's height at
///         its origin, which only GNSS heights show; the deviation of plumb lines from each other
///         (7 mm sideways at 300 m for 150 m of height).
/// Source  Snyder 1987, "Map projections", for convergence and scale.
struct ElevationGrid {
  int nx = 0, ny = 0;
  double cell_x_m = 0, cell_y_m = 0;
  std::vector<double> height_m;  ///< about the height of the grid's middle
  SiteOrigin origin;             ///< the grid's middle
  /// The file, and those beside it that GDAL reads with it (.tfw, .aux.xml).
  std::vector<std::filesystem::path> files;

  double width_m() const { return (nx - 1) * cell_x_m; }
  double depth_m() const { return (ny - 1) * cell_y_m; }
  /// Bilinear height at (x, y) metres from the middle, east and north.
  double HeightAt(double x_m, double y_m) const;
};

/// Reads a one-band elevation GeoTIFF in a projected or geographic reference system, its scale,
/// offset and unit applied (ReadHeights, georaster.h). Throws InputError if it is unreadable, has
/// no projection, is rotated, has gaps, marked or not, or more than 2.5e7 pixels.
ElevationGrid ReadElevation(const std::filesystem::path& file);

/// Classes of soil on a site, row-major with x fastest and y northwards.
///
/// Frames  the tangent plane at `origin`, as of an ElevationGrid.
/// Model   the file's classes, of the nearest pixel, looked up through its reference system on a
///         grid that encloses the file.
struct SoilClassGrid {
  int nx = 0, ny = 0;
  Vec2 first_m = Vec2::Zero();  ///< middle of cell (0, 0)
  Vec2 cell_m = Vec2::Zero();
  std::vector<std::uint8_t> value;
  std::optional<std::uint8_t> gap_value;     ///< the file's no-data value
  SiteOrigin origin;                         ///< height zero unless given
  std::vector<std::filesystem::path> files;  ///< as of ElevationGrid
};

/// Reads a one-band GeoTIFF of bytes. `about` is the site's origin where something else says it,
/// else it is the file's middle. Throws InputError as ReadElevation does, for pixels of another
/// type, and for a scale and offset whose results are not whole numbers from 0 to 255.
SoilClassGrid ReadSoilClasses(const std::filesystem::path& file,
                              const std::optional<SiteOrigin>& about);

}  // namespace tera
