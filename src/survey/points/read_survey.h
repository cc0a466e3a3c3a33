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
/// Frames  the map plane (east, north, up) if the survey has a map; else the file's own frame.
struct Survey {
  std::vector<Vec3> p_m;
  std::optional<MapReference> map;
  std::int64_t left_out = 0;    ///< points without coordinates, noise points and raster gaps
  std::optional<Vec2> pixel_m;  ///< for rasters
  std::vector<std::string> warnings;
};

/// Options for reading a survey.
struct SurveyReading {
  std::string map;                ///< reference system for a file that names none that can be read
  bool is_local = false;          ///< coordinates have no map, whatever the file names
  double coarsest_step_m = 0.02;  ///< largest acceptable step of the coordinates
};

/// Reads .pcd, .ply and .las as point clouds, and .tif and .tiff as elevation rasters.
///
/// Throws  InputError for two reference systems, for coordinates far outside the system's area, and
///         for coordinate steps (coarse_steps.h) above `coarsest_step_m`.
Survey ReadSurvey(const std::filesystem::path& file, const SurveyReading& how = {});

}  // namespace tera
