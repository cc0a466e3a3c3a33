#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "soil/site/map_reference.h"
#include "survey/site/terrain.h"
#include "survey/site/things.h"

namespace tera {

/// How a survey is to become a site.
struct SiteRequest {
  std::string map;  ///< reference system, where the file names none that is read
  /// Place of (0, 0, 0) of a survey without a map.
  SiteOrigin origin{47.3763, 8.5477, 0};
  bool about_middle = false;     ///< that the middle of such a survey lies there, not x = y = 0
  std::optional<double> cell_m;  ///< side of the terrain's cells
  double largest_thing_m = 6;    ///< smaller side of the largest thing that stands on the ground
  double steepest_rad = 0.79;    ///< slope up to which what rises is ground
  double gap_m = 0.5;            ///< between two things
};

/// A survey as a site: its ground, and what stands on it.
///
/// Frames  the map's plane, heights as in the survey; of a survey without a map, its own frame less
///         `middle_m`, about SiteRequest::origin, whose height is added.
struct SurveySite {
  MapReference map;
  bool has_map = false;          ///< that the survey was of one
  Vec2 middle_m = Vec2::Zero();  ///< with SiteRequest::about_middle, else zero
  std::vector<std::string> warnings;
  SurveyTerrain terrain;
  std::vector<SurveyThing> things;
  std::int64_t points = 0, left_out = 0, outliers = 0, ground_points = 0;
};

/// Reads a survey and takes it apart: outliers.h, ground_filter.h, terrain.h and things.h say how.
/// Throws InputError for a survey that is longer or wider than 2000 m, that has no map and lies
/// farther than that from its origin, that has points too sparse for the cells, or of which no
/// point is ground.
SurveySite MakeSurveySite(const std::filesystem::path& file, const SiteRequest& request);

}  // namespace tera
