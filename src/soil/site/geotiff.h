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
/// Model   The heights of the file, interpolated bilinearly onto a grid of the tangent plane. The
///         positions follow the reference system of the file, with its meridian convergence, scale
///         and datum. The drop of the ellipsoid below the plane, x^2 / 2N + y^2 / 2M, is
///         subtracted. Where the rotated grid extends beyond the file, the border height continues.
///         The heights of the file count as heights above the WGS 84 ellipsoid.
/// Omits   The geoid: heights above sea level shift the whole site by the geoid height at its
///         origin, which only GNSS heights show. The angle between plumb lines (7 mm sideways at
///         300 m for 150 m of height).
/// Source  Snyder 1987, "Map projections", for convergence and scale.
struct ElevationGrid {
  int nx = 0, ny = 0;
  double cell_x_m = 0, cell_y_m = 0;
  std::vector<double> height_m;  ///< relative to the height of the middle of the grid
  SiteOrigin origin;             ///< middle of the grid
  /// The file and the sidecar files that GDAL reads (.tfw, .aux.xml).
  std::vector<std::filesystem::path> files;

  double width_m() const { return (nx - 1) * cell_x_m; }
  double depth_m() const { return (ny - 1) * cell_y_m; }
  /// Bilinear height at (x, y) metres east and north of the middle.
  double HeightAt(double x_m, double y_m) const;
};

/// Reads a one-band elevation GeoTIFF in a projected or geographic reference system. Applies its
/// scale, offset and unit (ReadHeights, georaster.h). Throws InputError for a file that is
/// unreadable, has no projection, is rotated, has missing heights, or has more than 2.5e7 pixels.
ElevationGrid ReadElevation(const std::filesystem::path& file);

/// Soil classes of a site, row-major with x fastest and y northwards.
///
/// Frames  the tangent plane at `origin`, as in ElevationGrid.
/// Model   The class of the nearest pixel, found through the reference system of the file. The grid
///         encloses the file.
struct SoilClassGrid {
  int nx = 0, ny = 0;
  Vec2 first_m = Vec2::Zero();  ///< middle of cell (0, 0)
  Vec2 cell_m = Vec2::Zero();
  std::vector<std::uint8_t> value;
  std::optional<std::uint8_t> gap_value;     ///< no-data value of the file
  SiteOrigin origin;                         ///< height zero unless given
  std::vector<std::filesystem::path> files;  ///< as in ElevationGrid
};

/// Reads a one-band GeoTIFF of bytes. `about` is the origin of the site if it is known; otherwise
/// the origin is the middle of the file. Throws InputError as ReadElevation does, and for pixels of
/// another type. Also for a scale and offset that do not give whole numbers from 0 to 255.
SoilClassGrid ReadSoilClasses(const std::filesystem::path& file,
                              const std::optional<SiteOrigin>& about);

}  // namespace tera
