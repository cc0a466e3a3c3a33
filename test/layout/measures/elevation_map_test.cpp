#include "layout/measures/elevation_map.h"

#include <gtest/gtest.h>

#include "layout/looked_at_site.h"

namespace tera {
namespace {

TEST(ElevationMap, BeyondTheSiteIsNoGap) {
  // A site of 30 m about W's origin, and a viewer 3 m above its ground that sees all of that to the
  // edge, 2.5 m ahead, and nothing of the land beyond.
  const LookedAtSite site({.size_m = 30});
  ViewField field = EverywhereAlike();
  field.per_steradian = [](const Vec3& d_S) { return d_S.x() < -d_S.z() * 2.5 / 3 ? 1e9 : 0.0; };
  Viewer viewer = ViewerAt("lidar", {0, 0, 0}, field);
  viewer.X_WS = MakePose({12.5, 0, 3});
  for (const auto& [from_m, to_m] : {std::pair(10, 20), {20, 25}}) {
    ElevationMap map({.low_H_m = Vec2(from_m, -2), .high_H_m = Vec2(to_m, 2), .cell_m = 0.5});
    map.Add(Pose::Identity(), LayoutOf({viewer}), 0.2, site.sighting(), site.ground());
    EXPECT_NEAR(FigureOf(map.Figures(), "elevation/gaps").at.at(0), 0, 1e-9);
    EXPECT_NEAR(FigureOf(map.Figures(), "elevation/sigma_m").at.at(0), 0, 1e-3);
  }
}

}  // namespace
}  // namespace tera
