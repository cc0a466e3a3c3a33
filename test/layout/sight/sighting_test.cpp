#include "layout/sight/sighting.h"

#include <gtest/gtest.h>

#include "layout/yard.h"

namespace tera {
namespace {

/// From 2 m behind the box on the mast, straight through it and on, 10 m in all.
Sighting::Line Through(const Yard& yard) {
  return {yard.X_WMast() * Vec3(-1, 0.1, 0.5), yard.X_WMast() * Vec3(9, 0.1, 0.5)};
}

TEST(Sighting, TellsEverySurfaceOnALineInOrder) {
  const Yard yard({Vec3(1, -0.3, 0), Vec3(1.8, 0.3, 1)});
  const std::vector<Sighting::Line> lines = {
      Through(yard),
      {yard.X_WMast() * Vec3(1.5, 0.1, 0.5), yard.X_WMast() * Vec3(1.5, 0.1, 5)},   // from inside
      {yard.X_WMast() * Vec3(-1, 0.1, 0.5), yard.X_WMast() * Vec3(0.5, 0.1, 0.5)},  // ends before
  };
  const auto crossings = yard.sighting().CrossingsOf(lines);
  ASSERT_EQ(crossings.size(), 3u);
  ASSERT_EQ(crossings[0].size(), 2u);
  EXPECT_NEAR(crossings[0][0].at_m, 2.0, 1e-4);
  EXPECT_FALSE(crossings[0][0].leaves);
  EXPECT_NEAR(crossings[0][1].at_m, 2.8, 1e-4);
  EXPECT_TRUE(crossings[0][1].leaves);
  EXPECT_FALSE(crossings[0][0].is_glass);
  EXPECT_EQ(yard.sighting().NameOf({crossings[0][0].instance}), "digger/mast");
  ASSERT_EQ(crossings[1].size(), 1u);
  EXPECT_NEAR(crossings[1][0].at_m, 0.5, 1e-4);
  EXPECT_TRUE(crossings[1][0].leaves);
  EXPECT_TRUE(crossings[2].empty());
}

TEST(Sighting, ASurfaceWithinATouchOfALinesEndDoesNotBlockIt) {
  const Yard yard({Vec3(1, -0.3, 0), Vec3(1.8, 0.3, 1)});
  const Vec3 from_W_m = yard.X_WMast() * Vec3(-1, 0.1, 0.5);
  const auto to = [&](double x_m) { return yard.X_WMast() * Vec3(x_m, 0.1, 0.5); };
  const std::vector<Sighting::Line> lines = {{from_W_m, to(1.029)}, {from_W_m, to(1.031)}};
  const auto blocked = yard.sighting().Try(lines);
  EXPECT_FALSE(blocked[0]);
  EXPECT_TRUE(blocked[1]);
}

}  // namespace
}  // namespace tera
