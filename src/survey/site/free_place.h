#pragma once

#include <optional>

#include "survey/site/survey_site.h"

namespace tera {

/// Free space that a machine needs.
struct PlaceNeed {
  double radius_m = 2.5;       ///< radius of the level, measured ground
  double clearance_m = 4;      ///< distance from things and the survey's border
  double most_relief_m = 0.5;  ///< between the highest and the lowest ground of the circle
};

/// The most level place for a machine, in the site's plane. Distance from the middle decides
/// between similar places. Returns nothing if no place fits.
std::optional<Vec2> FindFreePlace(const SurveySite& site, const PlaceNeed& need);

/// The place for a mast: the measured ground farthest from the middle that is clear of things.
Vec2 FindOverlook(const SurveySite& site);

}  // namespace tera
