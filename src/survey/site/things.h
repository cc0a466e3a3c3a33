#pragma once

#include <vector>

#include "survey/site/footprint.h"
#include "survey/site/terrain.h"

namespace tera {

/// Something on the ground, unclassified, as its bounding box from the lowest ground under it to
/// its top.
struct SurveyThing {
  Footprint footprint;
  double foot_m = 0, top_m = 0;  ///< heights in the points' frame
  double ground_m = 0;           ///< ground height at the footprint's middle
  std::int64_t points = 0;
};

/// Rule that groups points into things.
struct ThingRule {
  double gap_m = 0.5;    ///< points closer than this belong together
  double voxel_m = 0.1;  ///< points are counted by cubes of this edge, so density has no effect
  int least_voxels = 8;
};

/// The things of a survey, largest first.
///
/// Model   Points above the ground form clusters of neighbours (PCL's EuclideanClusterExtraction).
///         Each cluster becomes an upright box over its rectangle of least area.
/// Omits   things closer than the gap become one thing; a tree is the box of its crown.
std::vector<SurveyThing> FindThings(const std::vector<Vec3>& p_m, const std::vector<float>& above_m,
                                    const SurveyTerrain& terrain, const ThingRule& rule);

}  // namespace tera
