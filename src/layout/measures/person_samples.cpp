#include "layout/measures/person_samples.h"

#include "core/units.h"
#include "layout/measures/polar_grid.h"
#include "layout/sight/look.h"

namespace tera {
namespace {

constexpr int kPatchesUp = 4, kPatchesAcross = 2;
constexpr double kMiddle_m = 0.9;  ///< height of a standing person's centre

}  // namespace

std::vector<PersonPlace> PlacesAroundHull(const Pose& X_WH, const std::vector<double>& hull_m,
                                          const std::vector<double>& distances_m,
                                          const Sighting& sighting, const TerrainSurface& ground) {
  const int sectors = static_cast<int>(hull_m.size());
  std::vector<PersonPlace> places;
  for (int sector = 0; sector < sectors; ++sector) {
    const Mat3 R_HP(Eigen::AngleAxisd(2 * kPi * sector / sectors, Vec3::UnitZ()));
    const Mat3 R_WP = X_WH.linear() * R_HP;
    for (std::size_t step = 0; step < distances_m.size(); ++step) {
      const double radius_m = hull_m[sector] + distances_m[step];
      Vec3 p_W_m = X_WH.translation() + radius_m * R_WP.col(0);
      if (!IsOnSite(ground, p_W_m)) continue;
      p_W_m.z() = ground.HeightAt(p_W_m.x(), p_W_m.y());
      places.push_back({sector, static_cast<int>(step), MakePose(p_W_m, R_WP)});
    }
  }
  std::vector<Vec3> middles_W_m;
  for (const PersonPlace& place : places) {
    middles_W_m.push_back(place.X_WP.translation() + Vec3(0, 0, kMiddle_m));
  }
  const std::vector<bool> inside = sighting.AreInside(middles_W_m);
  std::vector<PersonPlace> free;
  for (std::size_t p = 0; p < places.size(); ++p) {
    if (!inside[p]) free.push_back(places[p]);
  }
  return free;
}

std::vector<BodyPatch> PatchesOf(const Posture& posture) {
  const Vec3 half_m = 0.5 * posture.size_m;
  std::vector<BodyPatch> patches;
  for (int axis = 0; axis < 3; ++axis) {
    for (const int side : {-1, 1}) {
      if (axis == 2 && side < 0) continue;
      const int across = axis == 0 ? 1 : 0, up = axis == 2 ? 1 : 2;
      Vec3 normal = Vec3::Zero();
      normal[axis] = side;
      for (int i = 0; i < kPatchesAcross; ++i) {
        for (int j = 0; j < kPatchesUp; ++j) {
          Vec3 p_m = normal.cwiseProduct(half_m);
          p_m[across] = half_m[across] * (2 * (i + 0.5) / kPatchesAcross - 1);
          p_m[up] = half_m[up] * (2 * (j + 0.5) / kPatchesUp - 1);
          p_m.z() += half_m.z();
          const double side_m2 = 4 * half_m[across] * half_m[up];
          patches.push_back({p_m, normal, side_m2 / (kPatchesAcross * kPatchesUp)});
        }
      }
    }
  }
  return patches;
}

std::vector<double> SamplesOnPersons(const std::vector<BodyPatch>& patches,
                                     const std::vector<Pose>& X_WP, const Viewer& viewer,
                                     double reflectance, const Sighting& sighting) {
  std::vector<Target> targets;
  for (const Pose& X_WP_of : X_WP) {
    for (const BodyPatch& patch : patches) {
      targets.push_back({X_WP_of * patch.p_P_m, X_WP_of.linear() * patch.normal_P});
    }
  }
  const std::vector<Look> looks = LookFrom(viewer, targets, {.reflectance = reflectance}, sighting);
  std::vector<double> count(X_WP.size(), 0);
  for (std::size_t i = 0; i < looks.size(); ++i) {
    const BodyPatch& patch = patches[i % patches.size()];
    if (looks[i].sees) count[i / patches.size()] += looks[i].per_m2 * patch.area_m2;
  }
  return count;
}

}  // namespace tera
