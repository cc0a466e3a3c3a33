#pragma once

#include <vector>

#include "survey/site/footprint.h"
#include "survey/site/terrain.h"

namespace tera {

/// Something that stands on the ground, as the box that holds it: from the lowest ground under it
/// to its top. What it is stays open.
struct SurveyThing {
  Footprint footprint;
  double foot_m = 0, top_m = 0;  ///< heights, as those of the points
  double ground_m = 0;           ///< of the ground at the footprint's middle
  std::int64_t points = 0;
};

/// What makes points one thing.
struct ThingRule {
  double gap_m = 0.5;    ///< points nearer to each other belong together
  double voxel_m = 0.1;  ///< points are counted by cubes, so that density counts for nothing
  int least_voxels = 8;
};

/// The things of a survey, largest first.
///
/// Model   Points above the ground in clusters of neighbours (PCL's EuclideanClusterExtraction),
///         each in the rectangle of the least area that holds it, upright.
/// Omits   what is nearer to each other than the gap is one thing; a tree is the box of its crown.
std::vector<SurveyThing> FindThings(const std::vector<Vec3>& p_m, const std::vector<float>& above_m,
                                    const SurveyTerrain& terrain, const ThingRule& rule);

}  // namespace tera
