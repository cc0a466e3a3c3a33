#include "layout/sight/hull.h"

#include <algorithm>

#include "core/units.h"

namespace tera {
namespace {

constexpr double kHighest_m = 1.75;   ///< height of a person
constexpr double kThinnest_m = 0.05;  ///< step of the tested heights; thinner parts may be missed
constexpr double kHullReach_m = 20;   ///< no part of a machine is farther from its origin

bool IsHull(SemanticClass label) {
  return label == SemanticClass::kUndercarriage || label == SemanticClass::kUpperStructure ||
         label == SemanticClass::kTrack || label == SemanticClass::kBlade;
}

}  // namespace

std::vector<double> HullRadii_m(const Pose& X_WH, std::size_t machine, int sectors,
                                const Sighting& sighting) {
  const std::vector<bool> is_hull = sighting.InstancesOf(machine, IsHull);
  std::vector<double> radii_m;
  for (int sector = 0; sector < sectors; ++sector) {
    const Mat3 turn(Eigen::AngleAxisd(2 * kPi * sector / sectors, Vec3::UnitZ()));
    double farthest_m = 0;
    for (int k = 1; k * kThinnest_m <= kHighest_m; ++k) {
      const double height_m = k * kThinnest_m;
      const Vec3 middle_W_m = X_WH * Vec3(0, 0, height_m);
      const Vec3 out_W_m = X_WH.linear() * turn.col(0);
      const double to_m =
          sighting.NearestOf(is_hull, middle_W_m + kHullReach_m * out_W_m, -out_W_m, kHullReach_m);
      farthest_m = std::max(farthest_m, kHullReach_m - to_m);
    }
    radii_m.push_back(farthest_m);
  }
  return radii_m;
}

}  // namespace tera
