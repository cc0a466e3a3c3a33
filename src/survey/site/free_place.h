#pragma once

#include <optional>

#include "survey/site/survey_site.h"

namespace tera {

/// What a machine needs about itself.
struct PlaceNeed {
  double radius_m = 2.5;       ///< of level ground that was measured
  double clearance_m = 4;      ///< from things and the survey's border
  double most_relief_m = 0.5;  ///< between the highest and the lowest ground of the circle
};

/// The most level place for a machine, nearer to the middle of two that are alike; nothing where
/// there is none. In the site's plane.
std::optional<Vec2> FindFreePlace(const SurveySite& site, const PlaceNeed& need);

/// The place for a mast: on measured ground, away from things, as far from the middle as there is.
Vec2 FindOverlook(const SurveySite& site);

}  // namespace tera
