#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/motion.h"
#include "soil/soil.h"

namespace tera {

/// Values of one kind in squares of the site.
///
/// Frames  W.
struct SiteMap {
  Vec2 low_W_m = Vec2::Zero();  ///< south-western corner of the first square
  double square_m = 1;
  int nx = 0, ny = 0;
  std::vector<float> values;  ///< row by row from the south; NaN: not known
  std::string unit, description;
};

/// Writes it as GeoTIFF, float32, with NaN for no data, in the projection of the ground's rasters
/// (ground_raster.h). Throws InputError where it cannot be written. The file appears under its name
/// when complete.
void WriteSiteMap(const std::filesystem::path& file, const SiteMap& map, const SiteOrigin& origin);

/// Reads a raster of the ground (ground_raster.h) of a site whose origin is `origin`.
///
/// Model   a raster of more than `most_side` pixels along a side is reduced to squares, just large
///         enough to stay within. A square holds the mean of its pixels, or their most frequent
///         class. Pixels at the eastern and southern borders that do not fill a square are left
///         out.
/// Throws InputError where the file cannot be read or is in another projection.
SiteMap ReadSiteMap(const std::filesystem::path& file, const SiteOrigin& origin, int most_side);

/// The same of heights above the ellipsoid, as z of W.
SiteMap ReadSiteHeights(const std::filesystem::path& file, const SiteOrigin& origin, int most_side);

}  // namespace tera
