#include "layout/measures/coverage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "layout/looked_at_site.h"
#include "sensors/lidar/lidar_view.h"

namespace tera {
namespace {

using testing::ElementsAre;
using testing::Pair;

Zone Box(const Vec3& low_m, const Vec3& high_m) {
  Zone zone;
  zone.name = "box";
  zone.X_FZ = MakePose(0.5 * (low_m + high_m));
  zone.shape = ZoneBox{high_m - low_m};
  return zone;
}

constexpr int kMany = 40000;

/// Coverage of a zone with frame H by a layout.
ZoneCoverage Covered(const LookedAtSite& site, const Zone& zone, const Layout& layout,
                     int places = kMany, const SeenFrom& seen = {}) {
  ZoneCoverage coverage(zone, places, 5);
  coverage.Add(coverage.PlacesInAir(X_WH(), site.sighting(), site.ground()), layout, seen,
               site.sighting());
  return coverage;
}

double At(const ZoneCoverage& coverage, const std::string& name) {
  return FigureOf(coverage.Figures(), "zone/box/" + name).at.at(0);
}
double ErrorAt(const ZoneCoverage& coverage, const std::string& name) {
  return FigureOf(coverage.Figures(), "zone/box/" + name).error.at(0);
}

TEST(ZoneCoverage, ALidarThatLooksEverywhereSeesAllOfACubeAroundIt) {
  LidarModel lidar;
  for (int b = 0; b < 90; ++b) lidar.elevation_rad.push_back((89 - 2 * b) * kDeg);
  lidar.azimuth_offset_rad.assign(90, 0);
  lidar.firing_offset_s.assign(90, 0);
  lidar.min_range_m = 0;
  const LookedAtSite site({});
  const auto coverage = Covered(site, Box({-2, -2, 4}, {2, 2, 8}),
                                LayoutOf({ViewerAt("lidar", {0, 0, 6}, ViewOf(lidar, 10))}));
  EXPECT_EQ(At(coverage, "seen_by_1"), 1);
  EXPECT_EQ(At(coverage, "seen_by_2"), 0);
  EXPECT_EQ(At(coverage, "blind_m3"), 0);
  EXPECT_TRUE(coverage.Causes().empty());
}

TEST(ZoneCoverage, WithoutAViewerAllIsBlind) {
  const LookedAtSite site({});
  const auto coverage = Covered(site, Box({4, -2, 1}, {8, 2, 2}), LayoutOf({}));
  EXPECT_EQ(At(coverage, "seen_by_1"), 0);
  EXPECT_NEAR(At(coverage, "blind_m3"), 16, 1e-9);
}

// From (0, 0, 2), a wall at x = 3 with half a width of 1 m, higher than every line into the zone,
// hides |y| < x / 3. For x from 4 to 8 and y from -4 to 4, that is (8^2 - 4^2) / 3 = 16 of 32.
const SiteText kWall = {.boxes = {{"wall1", {3, -1, 0}, {3.2, 1, 6}}}};
const Zone kBehind = Box({4, -4, 0.5}, {8, 4, 1.5});

TEST(ZoneCoverage, AWallHidesItsShadow) {
  const LookedAtSite site(kWall);
  const auto coverage = Covered(site, kBehind, LayoutOf({ViewerAt("eye", {0, 0, 2})}));
  EXPECT_NEAR(At(coverage, "seen_by_1"), 0.5, 0.005);
  EXPECT_NEAR(At(coverage, "blind_m3"), 16, 0.16);
  ASSERT_THAT(coverage.Causes(), ElementsAre(Pair("wall1", testing::DoubleNear(1, 1e-12))));
}

TEST(ZoneCoverage, AWallThatIsLowHidesWhatLiesBelowItsEdge) {
  const LookedAtSite site({.boxes = {{"wall1", {3, -30, 0}, {3.2, 30, 1}}}});
  const auto coverage =
      Covered(site, Box({3.4, -1, 0}, {5.4, 1, 2}), LayoutOf({ViewerAt("eye", {0, 0, 3})}));
  // From (0, 0, 3), the line over the wall's far edge, at 3.2 m, falls by 2 / 3.2 per metre. It is
  // at 0.875 m at x = 3.4 and on the ground at 4.8. This triangle of a section of 2 x 2 is hidden.
  EXPECT_NEAR(At(coverage, "seen_by_1"), 1 - 0.5 * 1.4 * 0.875 / 4, 0.005);
}

TEST(ZoneCoverage, MorePlacesChangeAFigureByLessThanItsError) {
  const LookedAtSite site(kWall);
  const Layout layout = LayoutOf({ViewerAt("eye", {0, 0, 2}), ViewerAt("other", {0, 3, 2.5})});
  // Half the spacing gives eight times as many places.
  const auto coarse = Covered(site, kBehind, layout, 1000),
             fine = Covered(site, kBehind, layout, 8000);
  for (const std::string name : {"seen_by_1", "seen_by_2", "blind_m3"}) {
    EXPECT_LT(std::abs(At(coarse, name) - At(fine, name)), ErrorAt(coarse, name)) << name;
    EXPECT_GT(ErrorAt(fine, name), 0) << name;
    // Errors of counted shares fall with the root of the number of places.
    EXPECT_NEAR(ErrorAt(fine, name), ErrorAt(coarse, name) / std::sqrt(8.0),
                0.15 * ErrorAt(fine, name))
        << name;
  }
}

TEST(ZoneCoverage, AnErrorHoldsTheTruth) {
  const LookedAtSite site(kWall);
  const Layout layout = LayoutOf({ViewerAt("eye", {0, 0, 2})});
  for (const int places : {30, 200, 1000, 5000}) {
    const auto coverage = Covered(site, kBehind, layout, places);
    EXPECT_NEAR(At(coverage, "seen_by_1"), 0.5, 3 * ErrorAt(coverage, "seen_by_1")) << places;
    EXPECT_NEAR(At(coverage, "blind_m3"), 16, 3 * ErrorAt(coverage, "blind_m3")) << places;
  }
}

TEST(ZoneCoverage, CountsHowManySee) {
  // Three viewers in one place that look ahead, ahead and left. Two see half of a box around them,
  // and the third sees half of that.
  const auto towards = [](const Vec3& d_S) {
    ViewField field = EverywhereAlike();
    field.per_steradian = [d_S](const Vec3& d) { return d.dot(d_S) > 0 ? 1e9 : 0.0; };
    return field;
  };
  const LookedAtSite site({});
  const auto coverage = Covered(site, Box({-2, -1, 1}, {2, 1, 2}),
                                LayoutOf({ViewerAt("a", {0, 0, 1.5}, towards(Vec3::UnitX())),
                                          ViewerAt("b", {0, 0, 1.5}, towards(Vec3::UnitX())),
                                          ViewerAt("c", {0, 0, 1.5}, towards(Vec3::UnitY()))}));
  EXPECT_NEAR(At(coverage, "seen_by_1"), 0.75, 0.0075);
  EXPECT_NEAR(At(coverage, "seen_by_2"), 0.5, 0.005);
  EXPECT_NEAR(At(coverage, "seen_by_3"), 0.25, 0.0025);
  EXPECT_NEAR(At(coverage, "blind_m3"), 2, 0.02);
  ASSERT_THAT(coverage.Causes(), ElementsAre(Pair("out of view", testing::DoubleNear(1, 1e-12))));
  // a and b see the same; a and c a quarter both and three quarters either.
  const auto overlaps = coverage.Overlaps();
  ASSERT_EQ(overlaps.size(), 3u);
  int whole = 0, third = 0;
  for (const auto& [pair, share] : overlaps) {
    whole += std::abs(share - 1) < 1e-12;
    third += std::abs(share - 1.0 / 3) < 0.005;
  }
  EXPECT_EQ(whole, 1);
  EXPECT_EQ(third, 2);
}

TEST(ZoneCoverage, SeesNoFartherThanItsPointsAreDense) {
  // 90 points per steradian are 10 per m2 at 3 m: a ball of 3 m in a cube of 6 m, pi / 6 of it. A
  // camera of 25^2 * 9 px per steradian has 25 px per metre there.
  const LookedAtSite site({});
  ViewField camera = EverywhereAlike(25 * 25 * 9);
  camera.samples = ViewField::Samples::kPixels;
  for (const ViewField& field : {EverywhereAlike(90), camera}) {
    const auto coverage = Covered(site, Box({-3, -3, 2}, {3, 3, 8}),
                                  LayoutOf({ViewerAt("sensor", {0, 0, 5}, field)}));
    EXPECT_NEAR(At(coverage, "seen_by_1"), kPi / 6, 0.005);
    ASSERT_THAT(coverage.Causes(),
                ElementsAre(Pair("too far or too sparse", testing::DoubleNear(1, 1e-12))));
  }
}

TEST(ZoneCoverage, SeesNoFartherThanItReachesAndNoNearerThanItBegins) {
  const LookedAtSite site({});
  ViewField field = EverywhereAlike();
  field.reach_m = [](double returned) { return returned < 0.21 ? 3.0 : 100.0; };
  field.nearest_m = 1.5;
  const auto coverage =
      Covered(site, Box({-3, -3, 2}, {3, 3, 8}), LayoutOf({ViewerAt("lidar", {0, 0, 5}, field)}));
  EXPECT_NEAR(At(coverage, "seen_by_1"), kPi / 6 * (1 - 1.0 / 8), 0.005);
}

TEST(ZoneCoverage, CausesAreSharesOfTheBlindPlaces) {
  // A wall hides |y| < x / 3 behind it, and the viewer looks ahead only. For x from -8 to 8, the
  // rear half is out of view. Half of the front half, from 4 to 8, is behind the wall.
  ViewField ahead = EverywhereAlike();
  ahead.per_steradian = [](const Vec3& d) { return d.x() > 0 ? 1e9 : 0.0; };
  const LookedAtSite site(kWall);
  Zone zone = Box({-8, -4, 0.5}, {8, 4, 1.5});
  ZoneCoverage coverage(zone, 60000, 5);
  coverage.Add(coverage.PlacesInAir(X_WH(), site.sighting(), site.ground()),
               LayoutOf({ViewerAt("eye", {0, 0, 2}, ahead)}), {}, site.sighting());
  // Areas: 64 out of view; the wall's shadow from x = 3.2 to 8, (8^2 - 3.2^2) / 3; next to it, the
  // region between the shadow and the wall from x = 3 on. The wall's inside does not count.
  const double out = 64, shadow = (64 - 3.2 * 3.2) / 3 + (3.2 * 3.2 - 9) / 3 - 0.2 * 2;
  const auto causes = coverage.Causes();
  ASSERT_EQ(causes.size(), 2u);
  EXPECT_NEAR(causes.at("out of view"), out / (out + shadow), 0.01);
  EXPECT_NEAR(causes.at("wall1"), shadow / (out + shadow), 0.01);
  EXPECT_NEAR(At(coverage, "blind_m3"), out + shadow, 0.01 * (out + shadow));
}

TEST(ZoneCoverage, NamesAPartOfTheMachineAndTheGround) {
  const LookedAtSite site({.parts = {{"undercarriage", {-1, -2, 0.1}, {1, 2, 3}}}});
  const auto machine =
      Covered(site, Box({2, -1, 0.5}, {3, 1, 1}), LayoutOf({ViewerAt("eye", {-3, 0, 1})}), 200);
  ASSERT_THAT(machine.Causes(), ElementsAre(Pair("machine1/part0", 1)));
  const LookedAtSite hill({.terrain = ", piles: [{xy_m: [2, 2], height_m: 3, soil: dirt}]"});
  // The pile lies between H's origin at (2, -3) and places about (2, 7.5) of W.
  ZoneCoverage behind(Box({-0.5, 9, 0.2}, {0.5, 10, 0.4}), 200, 5);
  behind.Add(behind.PlacesInAir(MakePose({2, -2, 0}), hill.sighting(), hill.ground()),
             LayoutOf({ViewerAt("eye", {0, 0, 0.5})}), {}, hill.sighting());
  ASSERT_THAT(behind.Causes(), ElementsAre(Pair("ground", 1)));
}

TEST(ZoneCoverage, OnlyAirCounts) {
  // Half of the zone lies below the ground, and a block takes a quarter of the rest.
  const LookedAtSite site({.boxes = {{"block1", {4, -1, 0}, {5, 1, 5}}}});
  ViewField blind = EverywhereAlike();
  blind.per_steradian = [](const Vec3&) { return 0.0; };
  const auto coverage =
      Covered(site, Box({4, -1, -1}, {8, 1, 1}), LayoutOf({ViewerAt("eye", {0, 0, 2}, blind)}));
  EXPECT_EQ(At(coverage, "seen_by_1"), 0);
  EXPECT_NEAR(At(coverage, "blind_m3"), 6, 0.06);
}

TEST(ZoneCoverage, BeyondTheSiteNothingCounts) {
  // A site of 30 m about W's origin: the nearer half of the zone, 4 m in W's x, lies on it.
  const LookedAtSite site({.size_m = 30});
  ZoneCoverage coverage(Box({13, -1, 1}, {17, 1, 2}), kMany, 5);
  coverage.Add(coverage.PlacesInAir(Pose::Identity(), site.sighting(), site.ground()), LayoutOf({}),
               {}, site.sighting());
  EXPECT_NEAR(At(coverage, "blind_m3"), 4, 0.04);
}

TEST(ZoneCoverage, AZoneWithoutAirHasFiguresThatAreNumbers) {
  const LookedAtSite site({});
  const auto coverage =
      Covered(site, Box({4, -1, -3}, {8, 1, -2}), LayoutOf({ViewerAt("eye", {0, 0, 2})}), 500);
  for (const Figure& figure : coverage.Figures()) {
    EXPECT_TRUE(std::isfinite(figure.at.at(0))) << NameOf(figure.id);
    EXPECT_TRUE(std::isfinite(figure.error.at(0))) << NameOf(figure.id);
  }
  EXPECT_EQ(At(coverage, "blind_m3"), 0);
}

TEST(ZoneCoverage, EveryMomentHasItsFigure) {
  const LookedAtSite site(kWall);
  ZoneCoverage coverage(kBehind, 5000, 5);
  const Layout seeing = LayoutOf({ViewerAt("eye", {6, 0, 3})});
  const Layout half = LayoutOf({ViewerAt("eye", {0, 0, 2})});
  for (const Layout* layout : {&seeing, &half, &seeing}) {
    coverage.Add(coverage.PlacesInAir(X_WH(), site.sighting(), site.ground()), *layout, {},
                 site.sighting());
  }
  const Figure figure = FigureOf(coverage.Figures(), "zone/box/seen_by_1");
  ASSERT_EQ(figure.at.size(), 3u);
  EXPECT_EQ(figure.at[0], 1);
  EXPECT_NEAR(figure.at[1], 0.5, 0.02);
  EXPECT_EQ(figure.at[2], 1);
  EXPECT_TRUE(IsMoreBetter(figure.id.measure));
  EXPECT_NEAR(MeanOf(figure), (2 + figure.at[1]) / 3, 1e-12);
  EXPECT_EQ(WorstOf(figure), figure.at[1]);
  const Figure blind = FigureOf(coverage.Figures(), "zone/box/blind_m3");
  EXPECT_FALSE(IsMoreBetter(blind.id.measure));
  EXPECT_EQ(WorstOf(blind), blind.at[1]);
}

}  // namespace
}  // namespace tera
