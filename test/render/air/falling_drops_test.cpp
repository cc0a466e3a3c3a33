#include "render/air/falling_drops.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tera {
namespace {

Pose Ahead() {  // looking along +y of W
  Mat3 R;
  R << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  return MakePose(Vec3(4, -2, 3), R);
}

TEST(FallingDrops, StreaksAreAsLongAsDropsFallInTheExposure) {
  // Straight down in still air. A wind of 8 m/s from the west tilts them to the right of a camera
  // that looks north: 2 m above the ground it has 0.79 of its speed.
  const Rain rain(20);
  for (const double wind_mps : {0.0, 8.0}) {
    const FallingDrops drops(rain, {.speed_mps = wind_mps, .from_rad = 1.5 * M_PI});
    const auto streaks = drops.Seen(Ahead(), 700'000'000, 0.004);
    ASSERT_GT(streaks.size(), 100u);
    for (const FallingDrops::Streak& streak : streaks) {
      const Vec3 way_C_m = streak.to_C_m - streak.from_C_m;
      EXPECT_NEAR(way_C_m.y(), 0.004 * Rain::FallSpeed_mps(streak.diameter_m), 1e-9);
      EXPECT_NEAR(way_C_m.x(), 0.004 * wind_mps * 0.788, 1e-4);
      EXPECT_NEAR(way_C_m.z(), 0, 1e-9);
    }
  }
}

TEST(FallingDrops, ThereAreAsManyAsMarshallAndPalmerHave) {
  // Drops above 2 mm within 4 m of the eye and before it: half a ball, less the nearest 0.15 m.
  const Rain rain(30);
  const FallingDrops drops(rain, {});
  double expected = 0, seen = 0;
  for (int k = 0; k < 40; ++k) {
    for (const auto& streak : drops.Seen(Ahead(), k * 1'700'000'000LL, 1e-6)) {
      if (streak.diameter_m > 2e-3) ++seen;
    }
    expected += rain.CountAbove_1pm3(2e-3) * (2 * M_PI / 3 * 64 - M_PI * 16 * 0.15);
  }
  // The same drops recur: the sample is their number in one box.
  EXPECT_NEAR(seen / expected, 1, 0.05);
}

TEST(FallingDrops, LongStreaksLetMoreLightThrough) {
  EXPECT_NEAR(FallingDrops::Cover(2, 2, 20), M_PI / 40, 1e-12);
  EXPECT_EQ(FallingDrops::Cover(4, 4, 3), 1);
}

}  // namespace
}  // namespace tera
