#pragma once

#include <vector>

#include "survey/site/footprint.h"
#include "survey/site/terrain.h"

namespace tera {

/// An unclassified object on the ground, as a bounding box from the lowest ground below it to its
/// top.
struct SurveyThing {
  Footprint footprint;
  double foot_m = 0, top_m = 0;  ///< heights in the frame of the points
  double ground_m = 0;           ///< ground height at the centre of the footprint
  std::int64_t points = 0;
};

/// Rule that groups points into things.
struct ThingRule {
  double gap_m = 0.5;    ///< points closer than this belong to one object
  double voxel_m = 0.1;  ///< cubes of this edge are counted instead of points, so that density has
                         ///< no effect
  int least_voxels = 8;
};

/// Objects of a survey, largest first.
///
/// Model   Points above the ground are clustered by distance (PCL's EuclideanClusterExtraction). A
///         cluster becomes an upright box over its rectangle of least area.
/// Omits   separation of objects closer than the gap: they become one object. A tree becomes the
///         box of its crown.
std::vector<SurveyThing> FindThings(const std::vector<Vec3>& p_m, const std::vector<float>& above_m,
                                    const SurveyTerrain& terrain, const ThingRule& rule);

}  // namespace tera
