#pragma once

#include <vector>

#include "layout/sight/sighting.h"
#include "layout/study/study.h"

namespace tera {

/// A place around a machine at which a person may stand, facing it.
///
/// Frames  P stands on the ground below her middle, x from the machine to her, z up.
struct PersonPlace {
  int sector = 0, step = 0;  ///< of the direction and of the distance
  Pose X_WP = Pose::Identity();
};

/// In each of the directions of `hull_m` (HullRadii_m), at each of the distances from there;
/// directions one after the other. Left out where she would stand in something solid, or beyond the
/// site.
std::vector<PersonPlace> PlacesAroundHull(const Pose& X_WH, const std::vector<double>& hull_m,
                                          const std::vector<double>& distances_m,
                                          const Sighting& sighting, const TerrainSurface& ground);

/// A part of a person's surface that is tried as one, in P.
struct BodyPatch {
  Vec3 p_P_m = Vec3::Zero(), normal_P = Vec3::UnitX();
  double area_m2 = 0;
};

/// The sides of a person's box but the one that she stands on, in eight patches each.
std::vector<BodyPatch> PatchesOf(const Posture& posture);

/// How many points or pixels a viewer has in one scan or picture on persons at `X_WP`, one alone at
/// a time.
///
/// Model   its samples on a square metre of each patch that it sees (look.h) times the patch's
/// area.
std::vector<double> SamplesOnPersons(const std::vector<BodyPatch>& patches,
                                     const std::vector<Pose>& X_WP, const Viewer& viewer,
                                     double reflectance, const Sighting& sighting);

}  // namespace tera
