#pragma once

#include <vector>

#include "layout/sight/sighting.h"
#include "layout/study/study.h"

namespace tera {

/// A place around a machine where a person stands, facing the machine.
///
/// Frames  P lies on the ground below the person's centre; x points from the machine to the person,
///         z up.
struct PersonPlace {
  int sector = 0, step = 0;  ///< indices of direction and distance
  Pose X_WP = Pose::Identity();
};

/// Places at each of the distances from the hull in each direction of `hull_m` (HullRadii_m),
/// direction by direction. Places inside a solid object or off the site are left out.
std::vector<PersonPlace> PlacesAroundHull(const Pose& X_WH, const std::vector<double>& hull_m,
                                          const std::vector<double>& distances_m,
                                          const Sighting& sighting, const TerrainSurface& ground);

/// A part of a person's surface, sampled as one target. Frame P.
struct BodyPatch {
  Vec3 p_P_m = Vec3::Zero(), normal_P = Vec3::UnitX();
  double area_m2 = 0;
};

/// Patches of a person's box: eight on each side, none on the bottom.
std::vector<BodyPatch> PatchesOf(const Posture& posture);

/// Number of points or pixels of one scan or picture on a person at each pose of `X_WP`. The
/// persons do not occlude each other.
///
/// Model   for each patch in sight (look.h), its samples per square metre times its area.
std::vector<double> SamplesOnPersons(const std::vector<BodyPatch>& patches,
                                     const std::vector<Pose>& X_WP, const Viewer& viewer,
                                     double reflectance, const Sighting& sighting);

}  // namespace tera
