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
  std::vector<std::string> warnings;
};

/// How a survey is to be read.
struct SurveyReading {
  std::string map;        ///< the reference system, where the file names none that is read
  bool is_local = false;  ///< that the coordinates are of no map, whatever such a file names
  double coarsest_step_m = 0.02;  ///< least difference of coordinates that will do
};

/// Reads .pcd, .ply and .las as point clouds, .tif and .tiff as elevation rasters.
///
/// Throws InputError for two reference systems, for coordinates that lie far from where the system
/// is meant for, and for a cloud with coarse_steps.h of more than is wanted.
Survey ReadSurvey(const std::filesystem::path& file, const SurveyReading& how = {});

}  // namespace tera
