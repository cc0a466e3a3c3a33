#pragma once

#include <filesystem>

#include "soil/columns/columns.h"
#include "soil/soil_view.h"

namespace tera {

/// Writes a raster of the ground as GeoTIFF: float32, classes as bytes.
///
/// Frames  a transverse Mercator projection whose origin is `origin`: x east, y north, in metres.
/// Model   each pixel covers `columns_per_pixel` columns to a side and is their mean (of classes,
///         what there is most of). Heights are above the WGS 84 ellipsoid, which falls
///         away below W's plane. Written strip by strip: of a large site only a strip is in memory.
/// Throws InputError where it cannot be written. The file appears under its name when complete.
void WriteGroundRaster(const std::filesystem::path& file, const Columns& columns,
                       GroundRaster raster, const SiteOrigin& origin, int columns_per_pixel);

}  // namespace tera
