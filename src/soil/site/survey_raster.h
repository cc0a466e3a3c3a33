#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/motion.h"
#include "soil/site/map_reference.h"

namespace tera {

/// The pixels of an elevation raster as points.
struct SurveyRaster {
  MapReference map;
  Vec2 pixel_m = Vec2::Zero();
  std::vector<Vec3> p_m;  ///< middles of pixels in the map's plane, with their heights
  std::int64_t gaps = 0;  ///< pixels without a height
};

/// Reads a one-band elevation GeoTIFF whose pixels may have gaps, marked as such, its scale, offset
/// and unit applied (ReadHeights, georaster.h). Throws InputError if it is unreadable, has no
/// projection, is rotated, its map is not in metres, or it has more than 2.5e7 pixels.
SurveyRaster ReadSurveyRaster(const std::filesystem::path& file);

/// Squares of a map's plane, to be written.
struct MapSquares {
  Vec2 low_m = Vec2::Zero();  ///< south-western corner of the first square
  double square_m = 1;
  int nx = 0, ny = 0;  ///< values are row by row from the south
};

/// Write them as GeoTIFF, heights in metres as float32, or classes as bytes. Throw InputError where
/// they cannot be written. The file appears under its name when complete.
void WriteHeights(const std::filesystem::path& file, const MapSquares& squares,
                  const std::vector<float>& height_m, const MapReference& map);
void WriteClasses(const std::filesystem::path& file, const MapSquares& squares,
                  const std::vector<std::uint8_t>& values, const std::string& description,
                  const MapReference& map);

}  // namespace tera
