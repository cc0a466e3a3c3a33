#include "layout/measures/layout_measures.h"

#include <gtest/gtest.h>

#include "layout/looked_at_site.h"

namespace tera {
namespace {

TEST(LayoutMeasures, TheVolumeAroundTheMachineStandsOnTheGround) {
  // Independent of the root's origin: here 0.7 m above the ground, on a tilted machine.
  const LookedAtSite site({});
  Instant now = site.now();
  Pose& X_WB = now.machines[0].links[0].X_WB;
  X_WB = MakePose(Vec3(0, 0, 0.7)) * X_WB * MakePose(Vec3::Zero(), 0.1, -0.2, 0);
  const LayoutStudy study = LoadStudy({});
  const LayoutMeasures measures(study, site.scenario(), site.assembly(), LayoutOf({}),
                                {{{Measure::kSeenBy1, "around"}}});
  const auto zones_W_m = measures.PlacesOf({now, site.sighting(), site.ground()}).zones_W_m;
  ASSERT_EQ(zones_W_m.size(), 1u);
  double lowest_m = 9, highest_m = 0;
  for (const Vec3& p_W_m : zones_W_m[0]) {
    lowest_m = std::min(lowest_m, p_W_m.z());
    highest_m = std::max(highest_m, p_W_m.z());
    EXPECT_LE((p_W_m - X_WB.translation()).head<2>().norm(), study.radius_m);
  }
  EXPECT_NEAR(lowest_m, 0, 0.05);
  EXPECT_NEAR(highest_m, study.height_m, 0.05);
}

TEST(LayoutMeasures, PixelsCountOutsideTheOutlineOfTheMachineAsMapsDo) {
  // A machine 3.2 m long ahead and lower than the places, 1.5 m above the ground: the middles of
  // three cells ahead lie above it.
  const LookedAtSite site({.parts = {{"undercarriage", {-1, -0.5, 0.1}, {3.2, 0.5, 0.8}}}});
  const LayoutStudy study = LoadStudy({});
  const LayoutMeasures measures(study, site.scenario(), site.assembly(), LayoutOf({}),
                                {{{Measure::kPixelShare, "detect"}}});
  const PolarPlaces pixels = measures.PlacesOf({site.now(), site.sighting(), site.ground()}).pixels;
  for (int ring = 0; ring < PolarGrid::kRings; ++ring) {
    EXPECT_EQ(pixels.count[PolarGrid::Index(0, ring)], ring > 2) << ring;
  }
}

}  // namespace
}  // namespace tera
