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

/// Options for converting a survey to a site.
struct SiteRequest {
  std::string map;  ///< coordinate reference system if the file names none that can be read
  /// Geodetic position of (0, 0, 0) for a survey without a reference system.
  SiteOrigin origin{47.3763, 8.5477, 0};
  bool about_middle = false;  ///< `origin` is the centre of such a survey instead of its x = y = 0
  std::optional<double> cell_m;  ///< edge of the terrain cells; absent: chosen by CellSize
  double largest_thing_m = 6;    ///< shorter side of the largest object on the ground
  double steepest_rad = 0.79;    ///< steepest slope that counts as ground
  double gap_m = 0.5;            ///< least distance between two objects
};

/// A site made from a survey: its ground and the objects on it.
///
/// Frames  Map coordinates with the heights of the survey. Without a reference system: the frame of
///         the survey minus `middle_m`, with SiteRequest::origin as its origin and its height
///         added.
struct SurveySite {
  MapReference map;
  bool has_map = false;          ///< the survey has a coordinate reference system
  Vec2 middle_m = Vec2::Zero();  ///< centre of the survey with SiteRequest::about_middle, otherwise
                                 ///< zero
  std::vector<std::string> warnings;
  SurveyTerrain terrain;
  std::vector<SurveyThing> things;
  std::int64_t points = 0, left_out = 0, outliers = 0, ground_points = 0;
};

/// Converts a survey to a site, with outliers.h, ground_filter.h, terrain.h and things.h.
///
/// Throws  InputError for a survey longer or wider than 2000 m. Also for one without a reference
///         system that is more than 2000 m from its origin, and if points are too sparse for the
///         cells or no point is ground.
SurveySite MakeSurveySite(const std::filesystem::path& file, const SiteRequest& request);

}  // namespace tera
