#pragma once

#include <optional>

#include "survey/site/survey_site.h"

namespace tera {

struct PlaceNeed {
  double radius_m = 2.5;       ///< radius of the circle of level, measured ground
  double clearance_m = 4;      ///< distance from objects and from the border of the survey
  double most_relief_m = 0.5;  ///< largest height difference of the ground in the circle
};

/// The most level place for a machine, in site coordinates. Among similar places, the one closest
/// to the centre of the site is chosen. Returns nullopt if there is none.
std::optional<Vec2> FindFreePlace(const SurveySite& site, const PlaceNeed& need);

/// A place for a mast: the point of measured ground that is farthest from the centre of the site
/// and clear of objects.
Vec2 FindOverlook(const SurveySite& site);

}  // namespace tera
