#include "layout/measures/shovel_view.h"

#include <gtest/gtest.h>

#include <cmath>

#include "layout/looked_at_site.h"

namespace tera {
namespace {

/// A blade of 2 m, its edge at the origin of its link.
Shovel Blade() {
  Shovel blade;
  blade.name = "blade";
  blade.profile_B_m = {{0, 0}, {0, 0.5}};
  blade.width_m = 2;
  return blade;
}

/// A metre above the ground 4 m ahead in H.
MachineState BladeAhead() {
  MachineState machine;
  machine.links.resize(1);
  machine.links[0].X_WB = X_WH() * MakePose({4, 0, 1});
  return machine;
}

double EdgeSeen(const LookedAtSite& site, const Viewer& viewer, double reflectance) {
  ShovelView view(Blade(), 0);
  view.Add(BladeAhead(), LayoutOf({viewer}), reflectance, site.sighting());
  return FigureOf(view.Figures(), "dig/blade/edge_seen").at.at(0);
}

TEST(ShovelView, IsSeenByALidarAsFarAsItsReflectanceLets) {
  // The edge is 4 to sqrt(17) = 4.12 m away.
  ViewField field = EverywhereAlike();
  field.reach_m = [](double returned) { return 3.95 * std::sqrt(returned / 0.2); };
  const LookedAtSite site({});
  EXPECT_EQ(EdgeSeen(site, ViewerAt("lidar", {0, 0, 1}, field), 0.2), 0);
  EXPECT_EQ(EdgeSeen(site, ViewerAt("lidar", {0, 0, 1}, field), 0.3), 1);
}

TEST(ShovelView, IsSeenOfAnEdgeWhatNoWallHides) {
  // A wall half way hides everything left of the middle.
  const LookedAtSite site({.boxes = {{"wall1", {2, 0, 0}, {2.1, 3, 4}}}});
  EXPECT_NEAR(EdgeSeen(site, ViewerAt("eye", {0, 0, 1}), 0.2), 0.5, 0.51 / 21);
}

}  // namespace
}  // namespace tera
