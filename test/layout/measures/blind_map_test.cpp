#include "layout/measures/blind_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "layout/looked_at_site.h"

namespace tera {
namespace {

BlindMap Mapped(const LookedAtSite& site, const Layout& layout, double height_m = 0.9) {
  BlindMap map(height_m);
  map.Add(PlacesAt(height_m, X_WH(), site.sighting(), site.ground()), layout, {}, site.sighting());
  return map;
}

double Blind_m2(const BlindMap& map, const std::string& to) {
  for (const Figure& figure : map.Figures()) {
    if (!NameOf(figure.id).ends_with("blind_m2_to_" + to)) continue;
    EXPECT_FALSE(IsMoreBetter(figure.id.measure));
    EXPECT_EQ(UnitOf(figure.id.measure), "m^2");
    return figure.at.at(0);
  }
  ADD_FAILURE() << "no figure to " << to;
  return 0;
}

/// Area of a sector between two radii.
double Ring_m2(double from_m, double to_m, double share = 1) {
  return share * kPi * (to_m * to_m - from_m * from_m);
}

TEST(PolarGrid, HasItsMiddlesWhereItsCellsAre) {
  // Sector 0 has its middle ahead, sector 18 to the left.
  EXPECT_TRUE(PolarGrid::Middle_m(0, 0).isApprox(Vec2(0.5, 0), 1e-12));
  EXPECT_TRUE(PolarGrid::Middle_m(18, 23).isApprox(Vec2(0, 23.5), 1e-12));
  EXPECT_TRUE(PolarGrid::Middle_m(71, 1).isApprox(
      1.5 * Vec2(std::cos(5 * kDeg), -std::sin(5 * kDeg)), 1e-12));
  std::set<std::size_t> indices;
  for (int s = 0; s < PolarGrid::kSectors; ++s) {
    for (int r = 0; r < PolarGrid::kRings; ++r) indices.insert(PolarGrid::Index(s, r));
  }
  EXPECT_EQ(indices.size(), 72u * 24);
  EXPECT_EQ(*indices.rbegin(), 72u * 24 - 1);
}

TEST(BlindMap, FromAboveNothingIsBlindOnALevelSite) {
  const LookedAtSite site({});
  for (const double height_m : {0.0, 0.9, 1.7}) {
    const BlindMap map = Mapped(site, LayoutOf({ViewerAt("eye", {0, 0, 3})}), height_m);
    EXPECT_EQ(map.height_m(), height_m);
    EXPECT_EQ(Blind_m2(map, "12m"), 0);
    EXPECT_EQ(Blind_m2(map, "24m"), 0);
    for (const double share : map.SeenShare()) EXPECT_EQ(share, 1);
  }
}

TEST(BlindMap, WithoutAViewerAllIs) {
  const LookedAtSite site({});
  const BlindMap map = Mapped(site, LayoutOf({}));
  EXPECT_NEAR(Blind_m2(map, "12m"), Ring_m2(0, 12), 1e-6);
  EXPECT_NEAR(Blind_m2(map, "24m"), Ring_m2(0, 24), 1e-6);
}

// A tall wall whose face lies 3 m ahead and spans 25 deg of azimuth, seen from the middle. It
// covers the five sectors ahead, from the ring that begins at 3 m. Its back is at most 3.1 m / cos
// 10 deg = 3.15 m away, so that no middle of a cell is in it.
SiteText WallAhead(double height_m = 9) {
  const double half_m = 3 * std::tan(12.5 * kDeg);
  return {.boxes = {{"wall1", {3, -half_m, 0}, {3.1, half_m, height_m}}}};
}

TEST(BlindMap, BehindAWallIsBlindAndNowhereElse) {
  const LookedAtSite site(WallAhead());
  const BlindMap map = Mapped(site, LayoutOf({ViewerAt("eye", {0, 0, 2})}));
  EXPECT_NEAR(Blind_m2(map, "12m"), Ring_m2(3, 12, 5.0 / 72), 1e-6);
  EXPECT_NEAR(Blind_m2(map, "24m"), Ring_m2(3, 24, 5.0 / 72), 1e-6);
  const std::vector<double> share = map.SeenShare();
  for (int s = 0; s < PolarGrid::kSectors; ++s) {
    for (int r = 0; r < PolarGrid::kRings; ++r) {
      const bool is_behind = (s <= 2 || s >= 70) && r >= 3;
      EXPECT_EQ(share[PolarGrid::Index(s, r)], is_behind ? 0 : 1) << s << " " << r;
    }
  }
}

TEST(BlindMap, ALowWallHidesTheGroundButNotWhatIsHigher) {
  // From 3 m over the edge of a wall of 1 m, 3.1 m away. Behind it the line falls by 2 / 3.1 per
  // metre: it reaches the ground at 4.65 m, and 0.9 m of height at 3.26 m. Across the sectors the
  // factor is 1 / cos: 4.72 m at 10 deg at most. The ring from 4 to 5 m has its middle at 4.5 m.
  const LookedAtSite site(WallAhead(1));
  const Layout layout = LayoutOf({ViewerAt("eye", {0, 0, 3})});
  EXPECT_NEAR(Blind_m2(Mapped(site, layout, 0), "12m"), Ring_m2(3, 5, 5.0 / 72), 1e-6);
  EXPECT_EQ(Blind_m2(Mapped(site, layout, 0.9), "12m"), 0);
}

TEST(BlindMap, ASecondViewerSeesBehindTheWall) {
  const LookedAtSite site(WallAhead());
  const BlindMap map =
      Mapped(site, LayoutOf({ViewerAt("eye", {0, 0, 2}), ViewerAt("far", {30, 0, 2})}));
  EXPECT_EQ(Blind_m2(map, "24m"), 0);
}

TEST(BlindMap, WhatIsInsideSomethingSolidDoesNotCount) {
  // Cells with middles in a block, by geometry.
  const LookedAtSite site({.boxes = {{"block1", {5, -2, 0}, {8, 2, 3}}}});
  ViewField nothing = EverywhereAlike();
  nothing.per_steradian = [](const Vec3&) { return 0.0; };
  const BlindMap map = Mapped(site, LayoutOf({ViewerAt("eye", {0, 0, 2}, nothing)}));
  const std::vector<double> share = map.SeenShare();
  double blind_m2 = 0;
  for (int s = 0; s < PolarGrid::kSectors; ++s) {
    for (int r = 0; r < PolarGrid::kRings; ++r) {
      const Vec2 p = PolarGrid::Middle_m(s, r);
      const bool is_in = p.x() > 5 && p.x() < 8 && std::abs(p.y()) < 2;
      const double value = share[PolarGrid::Index(s, r)];
      EXPECT_TRUE(is_in ? value < 0 : value == 0) << p.transpose() << ": " << value;
      if (!is_in && r < 12) blind_m2 += Ring_m2(r, r + 1, 1.0 / 72);
    }
  }
  EXPECT_NEAR(Blind_m2(map, "12m"), blind_m2, 1e-6);
}

TEST(BlindMap, BeyondTheSiteNothingCounts) {
  // A site of 30 m about W's origin.
  const LookedAtSite site({.size_m = 30});
  const std::vector<double> share =
      Mapped(site, LayoutOf({ViewerAt("eye", {0, 0, 3})})).SeenShare();
  int beyond = 0;
  for (int s = 0; s < PolarGrid::kSectors; ++s) {
    for (int r = 0; r < PolarGrid::kRings; ++r) {
      const Vec2 p_H = PolarGrid::Middle_m(s, r);
      const Vec3 p_W = X_WH() * Vec3(p_H.x(), p_H.y(), 0);
      const double over_m = p_W.head<2>().cwiseAbs().maxCoeff() - 15;
      if (std::abs(over_m) < 0.6) continue;  // within a cell of the border
      beyond += over_m > 0;
      EXPECT_EQ(share[PolarGrid::Index(s, r)]<0, over_m> 0) << p_W.transpose();
    }
  }
  EXPECT_GT(beyond, 100);
}

TEST(BlindMap, OverMomentsIsTheShareOfThoseThatCount) {
  const LookedAtSite site(WallAhead());
  BlindMap map(0.9);
  const Layout behind_wall = LayoutOf({ViewerAt("eye", {0, 0, 2})});
  const Layout before_wall = LayoutOf({ViewerAt("eye", {30, 0, 2}), ViewerAt("eye", {0, 0, 2})});
  for (const Layout* layout : {&behind_wall, &before_wall, &before_wall, &before_wall}) {
    map.Add(PlacesAt(0.9, X_WH(), site.sighting(), site.ground()), *layout, {}, site.sighting());
  }
  EXPECT_EQ(map.SeenShare()[PolarGrid::Index(0, 6)], 0.75);
  EXPECT_EQ(map.SeenShare()[PolarGrid::Index(30, 6)], 1);
  for (const Figure& figure : map.Figures()) {
    ASSERT_EQ(figure.at.size(), 4u);
    EXPECT_EQ(figure.error.size(), 4u);
    EXPECT_GT(figure.at[0], 0);
    EXPECT_EQ(figure.at[3], 0);
    EXPECT_EQ(WorstOf(figure), figure.at[0]);
  }
}

TEST(BlindMap, FiguresErrorHoldsWhatTheGridMisses) {
  // A wall of any width: the area of its shadow and that of the cells whose middles are in it
  // differ by less than three errors.
  for (const double half_deg : {7.0, 11.3, 23.9, 31.7}) {
    const double half_m = 4.3 * std::tan(half_deg * kDeg);
    const LookedAtSite site({.boxes = {{"wall1", {4.3, -half_m, 0}, {4.31, half_m, 9}}}});
    const BlindMap map = Mapped(site, LayoutOf({ViewerAt("eye", {0, 0, 2})}));
    // The sector to 12 m, less the triangle before the wall.
    const double shadow_m2 = half_deg * kDeg * 144 - 4.3 * half_m;
    for (const Figure& figure : map.Figures()) {
      if (!NameOf(figure.id).ends_with("12m")) continue;
      EXPECT_NEAR(figure.at[0], shadow_m2, 3 * figure.error[0]) << half_deg;
      EXPECT_LT(figure.error[0], 0.2 * shadow_m2);
    }
  }
}

}  // namespace
}  // namespace tera
