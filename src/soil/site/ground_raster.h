#pragma once

#include <filesystem>

#include "soil/columns/columns.h"
#include "soil/soil_view.h"

namespace tera {

/// Writes a raster of the ground as GeoTIFF: float32, or bytes for classes.
///
/// Frames  a transverse Mercator projection about `origin`: x east, y north, in metres.
/// Model   A pixel is the mean of `columns_per_pixel` x `columns_per_pixel` columns, or their most
///         frequent class. Heights are above the WGS 84 ellipsoid, which falls below the plane of W
///         with distance. The file is written in strips, so that only one strip is in memory.
/// Throws  InputError if the file cannot be written. The file appears under its name when complete.
void WriteGroundRaster(const std::filesystem::path& file, const Columns& columns,
                       GroundRaster raster, const SiteOrigin& origin, int columns_per_pixel);

}  // namespace tera
