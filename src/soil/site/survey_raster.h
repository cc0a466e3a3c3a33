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
  std::vector<Vec3> p_m;  ///< centres of pixels in the plane of the map, with heights
  std::int64_t gaps = 0;  ///< number of pixels without a height
};

/// Reads a one-band elevation GeoTIFF that may have marked missing heights. Applies its scale,
/// offset and unit (ReadHeights, georaster.h). Throws InputError for a file that is unreadable, has
/// no projection, is rotated, has more than 2.5e7 pixels, or a map that is not in metres.
SurveyRaster ReadSurveyRaster(const std::filesystem::path& file);

/// A grid of squares in the plane of a map, for output.
struct MapSquares {
  Vec2 low_m = Vec2::Zero();  ///< south-western corner of the first square
  double square_m = 1;
  int nx = 0, ny = 0;  ///< values are row by row from the south
};

/// Write a GeoTIFF: heights in metres as float32, classes as bytes. Throw InputError if the file
/// cannot be written. The file appears under its name when complete.
void WriteHeights(const std::filesystem::path& file, const MapSquares& squares,
                  const std::vector<float>& height_m, const MapReference& map);
void WriteClasses(const std::filesystem::path& file, const MapSquares& squares,
                  const std::vector<std::uint8_t>& values, const std::string& description,
                  const MapReference& map);

}  // namespace tera
