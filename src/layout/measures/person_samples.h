#pragma once

#include <vector>

#include "layout/sight/sighting.h"
#include "layout/study/study.h"

namespace tera {

/// A place for a person around a machine, facing it.
///
/// Frames  P lies on the ground below the person's middle, x from the machine to the person, z up.
struct PersonPlace {
  int sector = 0, step = 0;  ///< index of the direction and of the distance
  Pose X_WP = Pose::Identity();
};

/// Places in each direction of `hull_m` (HullRadii_m), at each distance from there, direction by
/// direction. Leaves out places inside something solid or off the site.
std::vector<PersonPlace> PlacesAroundHull(const Pose& X_WH, const std::vector<double>& hull_m,
                                          const std::vector<double>& distances_m,
                                          const Sighting& sighting, const TerrainSurface& ground);

/// A part of a person's surface that is sampled as one target, in P.
struct BodyPatch {
  Vec3 p_P_m = Vec3::Zero(), normal_P = Vec3::UnitX();
  double area_m2 = 0;
};

/// Eight patches for each side of a person's box except the bottom.
std::vector<BodyPatch> PatchesOf(const Posture& posture);

/// Points or pixels that a viewer has in one scan or picture of a person at each `X_WP`, one person
/// at a time.
///
/// Model   for each patch in sight (look.h), its samples per square metre times its area.
std::vector<double> SamplesOnPersons(const std::vector<BodyPatch>& patches,
                                     const std::vector<Pose>& X_WP, const Viewer& viewer,
                                     double reflectance, const Sighting& sighting);

}  // namespace tera
