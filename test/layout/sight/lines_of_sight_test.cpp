#include <gtest/gtest.h>

#include "layout/looked_at_site.h"
#include "layout/sight/sighting.h"

namespace tera {
namespace {

const SiteText kBoxes = {.boxes = {{"wall1", {3, -2, 0}, {3.2, 2, 4}},
                                   {"block1", {-5, -1, 0}, {-3, 1, 2}},
                                   {"sunk1", {-9, -3, -0.3}, {-6, 3, 1}}},
                         .parts = {{"undercarriage", {-1, -0.5, 0.1}, {1, 0.5, 0.8}}}};

class SightOverBoxes : public testing::Test {
 protected:
  /// The named obstacle between two places of H; empty with a free line of sight.
  std::string Between(const Vec3& from_H_m, const Vec3& to_H_m) {
    const Sighting::Line line{X_WH() * from_H_m, X_WH() * to_H_m};
    const auto blocked = site_.sighting().Try({&line, 1});
    return blocked[0] ? site_.sighting().NameOf(*blocked[0]) : "";
  }
  bool IsInside(const Vec3& p_H_m) { return site_.sighting().AreInside({X_WH() * p_H_m})[0]; }

  const LookedAtSite site_{kBoxes};
};

TEST_F(SightOverBoxes, IsBlockedByWhatLiesOnTheWayAndByNothingElse) {
  EXPECT_EQ(Between({0, 0, 2}, {6, 0, 2}), "wall1");
  EXPECT_EQ(Between({6, 0, 2}, {0, 0, 2}), "wall1");
  EXPECT_EQ(Between({0, 0, 2}, {2.9, 0, 2}), "");
  EXPECT_EQ(Between({0, 0, 2}, {6, 4.2, 2}), "");  // next to its edge at (3, 2)
  EXPECT_EQ(Between({0, 0, 2}, {6, 3.8, 2}), "wall1");
  EXPECT_EQ(Between({0, 0, 5}, {6, 0, 3.5}), "");  // over its edge at 4 m
  EXPECT_EQ(Between({0, 0, 5}, {6, 0, 2.5}), "wall1");
  EXPECT_EQ(Between({-5.5, 0, 1}, {0, 0, 1.5}), "block1");
  EXPECT_EQ(Between({-2, 0, 0.5}, {2, 0, 0.5}), "machine1/part0");
  EXPECT_EQ(Between({0, 0, 2}, {2, 5, -0.5}), "ground");
}

TEST_F(SightOverBoxes, WhatComesFirstIsNamed) {
  EXPECT_EQ(Between({-5.5, 0, 0.5}, {8, 0, 0.5}), "block1");
  EXPECT_EQ(Between({8, 0, 0.5}, {-8, 0, 0.5}), "wall1");
}

TEST_F(SightOverBoxes, APlaceOnASurfaceIsInSightOfWhatLooksAtItAndOfNothingElse) {
  EXPECT_EQ(Between({0, 0, 2}, {3, 0.5, 1}), "");
  EXPECT_EQ(Between({6, 0, 2}, {3, 0.5, 1}), "wall1");
  EXPECT_EQ(Between({0, 0, 2}, {1.5, 2, 0}), "");
  EXPECT_EQ(Between({0, 0, 2}, {2, 2, -0.01}), "");  // within the touch
}

TEST_F(SightOverBoxes, TheLandAroundTheSiteBlocksToo) {
  EXPECT_EQ(Between({0, 0, 2}, {0, 150, -20}), "ground");
}

TEST_F(SightOverBoxes, InsideIsWhatLiesInABox) {
  EXPECT_TRUE(IsInside({-4, 0.3, 1}));
  EXPECT_TRUE(IsInside({3.1, 1.9, 3.9}));
  for (double x = -4.9; x < -3; x += 0.2) EXPECT_TRUE(IsInside({x, 0.3 * x + 1, 0.3})) << x;
  EXPECT_FALSE(IsInside({-4, 0.3, 2.1}));
  EXPECT_FALSE(IsInside({-2.9, 0, 1}));
  EXPECT_FALSE(IsInside({0, 0, 3}));
  EXPECT_FALSE(IsInside({3.3, 0, 1}));
}

TEST_F(SightOverBoxes, InsideIsWhatLiesInABoxThatIsSunkIntoTheGround) {
  // A box sunk into the ground, with its bottom below the surface.
  EXPECT_TRUE(IsInside({-8, 0.3, 0.5}));
  EXPECT_TRUE(IsInside({-6.2, -2.5, 0.1}));
  EXPECT_FALSE(IsInside({-8, 0.3, 1.1}));
  EXPECT_FALSE(IsInside({-8, 3.2, 0.5}));
}

TEST_F(SightOverBoxes, AreAskedInAnyNumber) {
  EXPECT_TRUE(site_.sighting().Try({}).empty());
  EXPECT_TRUE(site_.sighting().AreInside({}).empty());
  const std::vector<Sighting::Line> lines(1001, {X_WH() * Vec3(0, 0, 2), X_WH() * Vec3(6, 0, 2)});
  const auto blocked = site_.sighting().Try(lines);
  ASSERT_EQ(blocked.size(), 1001u);
  for (const auto& b : blocked) EXPECT_TRUE(b.has_value());
}

TEST_F(SightOverBoxes, ALineOfNoLengthIsFree) { EXPECT_EQ(Between({0, 0, 2}, {0, 0, 2}), ""); }

TEST_F(SightOverBoxes, TheNearestOfAMachineIsFoundBehindWhateverElse) {
  const auto instances = site_.sighting().InstancesOf(
      0, [](SemanticClass label) { return label == SemanticClass::kUndercarriage; });
  const Mat3 R = X_WH().linear();
  // From behind the wall, 8 m ahead: the part's front face is at 1 m.
  EXPECT_NEAR(site_.sighting().NearestOf(instances, X_WH() * Vec3(8, 0.1, 0.4), -R.col(0), 20), 7,
              1e-4);
  EXPECT_EQ(site_.sighting().NearestOf(instances, X_WH() * Vec3(8, 0.1, 0.4), -R.col(0), 5), 5);
  EXPECT_EQ(site_.sighting().NearestOf(instances, X_WH() * Vec3(8, 0.1, 2), -R.col(0), 20), 20);
  EXPECT_EQ(site_.sighting().NearestOf(instances, X_WH() * Vec3(8, 0.1, 0.4), R.col(0), 20), 20);
}

}  // namespace
}  // namespace tera
