#pragma once

#include <filesystem>
#include <vector>

#include "soil/soil.h"

namespace tera {

/// Heights of a site, row-major with x fastest and y northwards.
///
/// Frames  the tangent plane at `origin`: x east, y north, z up, as in W.
/// Model   the file's heights, bilinear between its pixels, looked up on a grid of the tangent
///         plane through the file's reference system, so that meridian convergence, scale and datum
///         are accounted for; the ellipsoid's drop below the plane, x^2 / 2N + y^2 / 2M, is taken
///         off. Where the turned grid reaches over the file's border, the border's height goes on.
///         Heights in the file are taken as above the WGS 84 ellipsoid.
/// Omits   the geoid: a file of heights above sea level puts the site's origin too low or too high
///         by the geoid's height there, alike for the whole site, which only GNSS heights show; the
///         deviation of plumb lines from each other (7 mm sideways at 300 m for 150 m of height).
/// Source  Snyder 1987, "Map projections", for convergence and scale.
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
/// InputError if it is unreadable, has no projection, is rotated, has gaps, or is not in metres.
ElevationGrid ReadElevation(const std::filesystem::path& file);

/// Writes a surface as float32 metres above the ellipsoid, in a transverse Mercator projection
/// whose origin is `origin`. The file appears under its name when it is complete. Throws InputError
/// where it cannot be written.
void WriteElevation(const std::filesystem::path& file, const TerrainSurface& surface,
                    const SiteOrigin& origin);

}  // namespace tera
