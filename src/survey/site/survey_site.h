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

/// Options for making a site from a survey.
struct SiteRequest {
  std::string map;  ///< reference system for a file that names none that can be read
  /// Map position of (0, 0, 0) for a survey without a map.
  SiteOrigin origin{47.3763, 8.5477, 0};
  bool about_middle = false;     ///< `origin` is the middle of such a survey, not x = y = 0
  std::optional<double> cell_m;  ///< edge of the terrain's cells
  double largest_thing_m = 6;    ///< smaller side of the largest thing that stands on the ground
  double steepest_rad = 0.79;    ///< steepest rise that counts as ground
  double gap_m = 0.5;            ///< between two things
};

/// A survey as a site: its ground and the things on it.
///
/// Frames  the map plane, with the survey's heights. Without a map: the survey's frame minus
///         `middle_m`, about SiteRequest::origin, whose height is added.
struct SurveySite {
  MapReference map;
  bool has_map = false;          ///< the survey has a map
  Vec2 middle_m = Vec2::Zero();  ///< with SiteRequest::about_middle, else zero
  std::vector<std::string> warnings;
  SurveyTerrain terrain;
  std::vector<SurveyThing> things;
  std::int64_t points = 0, left_out = 0, outliers = 0, ground_points = 0;
};

/// Makes a site from a survey, by outliers.h, ground_filter.h, terrain.h and things.h.
///
/// Throws  InputError for a survey longer or wider than 2000 m; for one without a map farther than
///         that from its origin; for points too sparse for the cells; and if no point is ground.
SurveySite MakeSurveySite(const std::filesystem::path& file, const SiteRequest& request);

}  // namespace tera
