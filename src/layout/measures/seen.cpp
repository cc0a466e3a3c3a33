#include "layout/measures/seen.h"

#include <algorithm>

namespace tera {
namespace {

/// Required points (lidar) or pixels (camera) per square metre.
double LeastPer_m2(const SeenFrom& seen, const Viewer& viewer) {
  return viewer.field.samples == ViewField::Samples::kPoints
             ? seen.lidar_points_per_m2
             : seen.camera_px_per_m * seen.camera_px_per_m;
}

}  // namespace

std::vector<std::vector<Look>> LookAt(const std::vector<Vec3>& places_W_m, const Layout& layout,
                                      const SeenFrom& seen, const Sighting& sighting) {
  std::vector<std::vector<Look>> looks(places_W_m.size());
  const std::vector<Target> targets = InTheAir(places_W_m);
  for (const Viewer& viewer : layout.viewers) {
    const Asked asked{.reflectance = seen.reflectance, .least_per_m2 = LeastPer_m2(seen, viewer)};
    const std::vector<Look> from = LookFrom(viewer, targets, asked, sighting);
    for (std::size_t p = 0; p < from.size(); ++p) looks[p].push_back(from[p]);
  }
  return looks;
}

int SeenBy(const std::vector<Look>& looks) {
  return static_cast<int>(
      std::count_if(looks.begin(), looks.end(), [](const Look& look) { return look.sees; }));
}

}  // namespace tera
