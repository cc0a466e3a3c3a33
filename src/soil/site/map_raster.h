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

}  // namespace tera
