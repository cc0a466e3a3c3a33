#include "layout/measures/elevation_map.h"

#include <gtest/gtest.h>

#include <cmath>

#include "layout/looked_at_site.h"

namespace tera {
namespace {

TEST(ElevationMap, BeyondTheSiteIsNoGap) {
  // A site of 30 m about W's origin, and a viewer 3 m above its ground that sees all of it to the
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

/// 3 m above the origin of H; it sees what `sees` accepts, with a distance error of 2 cm.
Viewer LidarThatSees(std::function<bool(const Vec3&)> sees, double per_steradian) {
  ViewField field = EverywhereAlike();
  field.per_steradian = [=](const Vec3& d_S) { return sees(d_S) ? per_steradian : 0.0; };
  field.distance_sigma_m = [](double) { return 0.02; };
  return ViewerAt("lidar", {0, 0, 3}, field);
}

TEST(ElevationMap, TheErrorOfHeightsIsThatOfCellsWithPointsHoweverManyHaveNone) {
  // Two cells of 1 m by 7 m on level ground, with middles 3.5 m to the left and right of H. The
  // slant to a point is sqrt(3.5^2 + 3^2) m, with a cosine of incidence of 3 / slant. Distance
  // errors move it up by that cosine; the mean of n points errs by 1 / sqrt(n) as much.
  const LookedAtSite site({});
  const double slant_m = std::hypot(3.5, 3), cosine = 3 / slant_m, per_steradian = 4000;
  const double points = 7 * per_steradian * cosine / (slant_m * slant_m);
  for (const bool sees_both : {true, false}) {
    const Viewer viewer =
        LidarThatSees([=](const Vec3& d_S) { return sees_both || d_S.y() > 0; }, per_steradian);
    ElevationMap map({.low_H_m = Vec2(-0.5, -7), .high_H_m = Vec2(0.5, 7), .cell_m = 7});
    map.Add(X_WH(), LayoutOf({viewer}), 0.2, site.sighting(), site.ground());
    const auto figures = map.Figures();
    EXPECT_NEAR(FigureOf(figures, "elevation/gaps").at.at(0), sees_both ? 0 : 0.5, 1e-9);
    EXPECT_NEAR(FigureOf(figures, "elevation/sigma_m").at.at(0), 0.02 * cosine / std::sqrt(points),
                1e-9);
  }
}

TEST(ElevationMap, OfACellThatHardlyEverHasAPointTheErrorIsThatOfOnePoint) {
  const LookedAtSite site({});
  ElevationMap map({.low_H_m = Vec2(-0.5, 3), .high_H_m = Vec2(0.5, 4), .cell_m = 1});
  const Viewer viewer = LidarThatSees([](const Vec3&) { return true; }, 1e-6);
  map.Add(X_WH(), LayoutOf({viewer}), 0.2, site.sighting(), site.ground());
  EXPECT_NEAR(FigureOf(map.Figures(), "elevation/sigma_m").at.at(0), 0.02 * 3 / std::hypot(3.5, 3),
              1e-6);
}

TEST(ElevationMap, WithoutAnyPointItsHeightsAreKnownToAMetre) {
  const LookedAtSite site({});
  ElevationMap map({});
  map.Add(X_WH(), LayoutOf({}), 0.2, site.sighting(), site.ground());
  EXPECT_EQ(FigureOf(map.Figures(), "elevation/gaps").at.at(0), 1);
  EXPECT_EQ(FigureOf(map.Figures(), "elevation/sigma_m").at.at(0), 1);
}

}  // namespace
}  // namespace tera
