#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/motion.h"
#include "soil/soil.h"

namespace tera {

/// A map of the site in squares.
///
/// Frames  W.
struct SiteMap {
  Vec2 low_W_m = Vec2::Zero();  ///< south-western corner of the first square
  double square_m = 1;
  int nx = 0, ny = 0;
  std::vector<float> values;  ///< row by row from the south; NaN for unknown
  std::string unit, description;
};

/// Writes a float32 GeoTIFF with NaN as no-data, in the projection of ground_raster.h. Throws
/// InputError if the file cannot be written. The file appears under its name when complete.
void WriteSiteMap(const std::filesystem::path& file, const SiteMap& map, const SiteOrigin& origin);

/// Reads a raster of ground_raster.h of a site with this origin.
///
/// Model   A raster of more than `most_side` pixels along a side is reduced to squares of the least
///         sufficient size. A square holds the mean of its pixels, or their most frequent class.
///         Pixels at the eastern and southern borders that do not fill a square are dropped.
/// Throws  InputError if the file cannot be read or has another projection.
SiteMap ReadSiteMap(const std::filesystem::path& file, const SiteOrigin& origin, int most_side);

/// The same for heights above the ellipsoid, converted to z in W.
SiteMap ReadSiteHeights(const std::filesystem::path& file, const SiteOrigin& origin, int most_side);

}  // namespace tera
