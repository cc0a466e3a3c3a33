#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/motion.h"
#include "soil/site/map_reference.h"

namespace tera {

/// A survey's points.
///
/// Frames  the map's plane where it is of one, east, north and up; else the file's own frame.
struct Survey {
  std::vector<Vec3> p_m;
  std::optional<MapReference> map;
  std::int64_t left_out = 0;    ///< without a place, marked as noise, or gaps of a raster
  std::optional<Vec2> pixel_m;  ///< of a raster
};

/// Reads .pcd, .ply and .las as point clouds, .tif and .tiff as elevation rasters. `map` says which
/// reference system it is in where the file does not; both must not. Throws InputError.
Survey ReadSurvey(const std::filesystem::path& file, const std::string& map = "");

}  // namespace tera
