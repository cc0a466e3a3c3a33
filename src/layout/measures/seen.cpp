#include "layout/measures/seen.h"

#include <algorithm>

namespace tera {
namespace {

/// What can be said of a look before anything is in the way.
Look Unhindered(const Viewer& viewer, const Vec3& p_W_m, const SeenFrom& seen) {
  const Vec3 p_S_m = viewer.X_WS.inverse() * p_W_m;
  const double range_m = p_S_m.norm();
  if (range_m <= 0) return {};
  const double per_sr = viewer.field.per_steradian(p_S_m / range_m);
  if (per_sr <= 0) return {};
  const double per_m2 = per_sr / (range_m * range_m);
  const bool is_lidar = viewer.field.samples == ViewField::Samples::kPoints;
  const bool is_dense = is_lidar ? per_m2 >= seen.lidar_points_per_m2
                                 : per_m2 >= seen.camera_px_per_m * seen.camera_px_per_m;
  const bool is_near = is_lidar ? range_m <= viewer.field.reach_m(seen.reflectance)
                                : range_m <= viewer.field.reach_m(1);
  if (!is_dense || !is_near || (is_lidar && range_m < viewer.field.min_range_m)) {
    return {false, Unseen::kTooFarOrSparse, {}};
  }
  return {true, {}, {}};
}

}  // namespace

std::vector<std::vector<Look>> LookAt(const std::vector<Vec3>& places_W_m, const Layout& layout,
                                      const SeenFrom& seen, const Sighting& sighting) {
  std::vector<std::vector<Look>> looks(places_W_m.size(), std::vector<Look>(layout.viewers.size()));
  std::vector<Sighting::Line> lines;
  std::vector<Look*> asked;
  for (std::size_t v = 0; v < layout.viewers.size(); ++v) {
    const Viewer& viewer = layout.viewers[v];
    for (std::size_t p = 0; p < places_W_m.size(); ++p) {
      looks[p][v] = Unhindered(viewer, places_W_m[p], seen);
      if (!looks[p][v].sees) continue;
      lines.push_back({viewer.X_WS.translation(), places_W_m[p]});
      asked.push_back(&looks[p][v]);
    }
  }
  const std::vector<std::optional<Blocked>> blocked = sighting.Try(lines);
  for (std::size_t i = 0; i < asked.size(); ++i) {
    if (blocked[i]) *asked[i] = {false, Unseen::kBlocked, *blocked[i]};
  }
  return looks;
}

int SeenBy(const std::vector<Look>& looks) {
  return static_cast<int>(
      std::count_if(looks.begin(), looks.end(), [](const Look& look) { return look.sees; }));
}

}  // namespace tera
