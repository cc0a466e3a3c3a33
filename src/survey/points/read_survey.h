#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/motion.h"
#include "soil/site/map_reference.h"

namespace tera {

/// Points of a survey.
///
/// Frames  Map coordinates (east, north, up) if the survey has a coordinate reference system;
///         otherwise the frame of the file.
struct Survey {
  std::vector<Vec3> p_m;
  std::optional<MapReference> map;
  std::int64_t left_out = 0;  ///< skipped points: without coordinates, marked as noise, or gaps in
                              ///< a raster
  std::optional<Vec2> pixel_m;  ///< pixel size of a raster
  std::vector<std::string> warnings;
};

struct SurveyReading {
  std::string map;        ///< coordinate reference system if the file names none that can be read
  bool is_local = false;  ///< treat coordinates as local, even if the file names a reference system
  double coarsest_step_m = 0.02;  ///< largest accepted resolution of the coordinates
};

/// Reads .pcd, .ply and .las as point clouds, and .tif and .tiff as elevation rasters.
///
/// Throws  InputError if two reference systems are given, if coordinates are far outside the area
///         of the reference system, or if their resolution (coarse_steps.h) exceeds
///         `coarsest_step_m`.
Survey ReadSurvey(const std::filesystem::path& file, const SurveyReading& how = {});

}  // namespace tera
