#include "soil/track/ground_exit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "core/random.h"
#include "core/units.h"
#include "soil/columns/soil_type.h"
#include "soil/shaped_ground.h"

namespace tera {
namespace {

template <typename Height>
Columns Shaped(Height height_m, double cell_m = 0.1) {
  return testing_soil::ShapedColumns(testing_soil::Shipped("dirt"), cell_m, 101, height_m);
}

TEST(GroundExit, ThereIsNoneAboveTheGround) {
  const Columns ground = Shaped([](double x, double y) { return 0.3 * x - 0.2 * y + 1; });
  EXPECT_FALSE(FindGroundExit(ground, Vec3(1.23, 0.77, 0.3 * 1.23 - 0.2 * 0.77 + 1.001)));
  EXPECT_TRUE(FindGroundExit(ground, Vec3(1.23, 0.77, 0.3 * 1.23 - 0.2 * 0.77 + 0.999)));
}

TEST(GroundExit, OnASlopeItIsAlongTheNormal) {
  const Columns ground = Shaped([](double x, double y) { return 0.6 * x - 0.4 * y; });
  const Vec3 n = Vec3(-0.6, 0.4, 1).normalized();
  for (const double depth_m : {1e-9, 0.01, 0.08, 0.37}) {
    const Vec3 on(0.513, -1.127, 0.6 * 0.513 + 0.4 * 1.127);
    const auto exit = FindGroundExit(ground, on - depth_m * n);
    ASSERT_TRUE(exit) << depth_m;
    EXPECT_NEAR(exit->depth_m, depth_m, 1e-6);
    EXPECT_LT((exit->direction_W - n).norm(), 1e-4) << depth_m;
  }
}

TEST(GroundExit, InAWallItIsOutOfTheWallAndNearTheTopUpwards) {
  // From the floor at x = 0.5 up to the edge at x = 0.6, z = 1.2.
  const Columns ground = Shaped([](double x, double) { return x > 0.55 ? 1.2 : 0.0; });
  const Vec3 face = Vec3(-1.2, 0, 0.1).normalized();
  const auto at_foot =
      FindGroundExit(ground, Vec3(0.5, 0.21, 0.5) + 0.1 * 0.5 / 1.2 * Vec3::UnitX() - 0.15 * face);
  ASSERT_TRUE(at_foot);
  EXPECT_NEAR(at_foot->depth_m, 0.15, 1e-6);
  EXPECT_LT((at_foot->direction_W - face).norm(), 1e-4);
  const auto at_edge = FindGroundExit(ground, Vec3(0.9, 0.21, 1.1));
  ASSERT_TRUE(at_edge);
  EXPECT_NEAR(at_edge->depth_m, 0.1, 1e-6);
  EXPECT_LT((at_edge->direction_W - Vec3::UnitZ()).norm(), 1e-4);
}

TEST(GroundExit, UnderAFurrowItIsTowardsTheFurrow) {
  // The floor's edge at x = 0.2, z = -0.3 is a corner that the ground goes around.
  const Columns ground = Shaped([](double x, double) { return x > 0.15 ? -0.3 : 0.4; });
  const auto exit = FindGroundExit(ground, Vec3(0.17, 0, -0.34));
  ASSERT_TRUE(exit);
  EXPECT_NEAR(exit->depth_m, std::hypot(0.03, 0.04), 1e-6);
  EXPECT_LT((exit->direction_W - Vec3(0.6, 0, 0.8)).norm(), 1e-4);
}

TEST(GroundExit, DeepInTheGroundItIsStraightUp) {
  const Columns ground = Shaped([](double x, double) { return x > 0.15 ? 0.0 : 4.0; });
  const auto exit = FindGroundExit(ground, Vec3(-1.5, 0.3, 2.2));
  ASSERT_TRUE(exit);
  EXPECT_NEAR(exit->depth_m, 1.8, 1e-6);
  EXPECT_EQ(exit->direction_W, Vec3::UnitZ());
  const auto outside = FindGroundExit(ground, Vec3(40, 0.3, -0.2));
  ASSERT_TRUE(outside);
  EXPECT_NEAR(outside->depth_m, 0.2, 1e-6);
}

// All around within the way's length is ground, and at its end the surface.
TEST(GroundExit, NoShorterWayIsThereInUnevenGround) {
  const Stream random(11, "test/uneven");
  std::uint64_t cell = 0;
  const Columns ground = Shaped(
      [&](double x, double) { return 0.12 * random.Uniform(cell++, 0) + (x > 0.25 ? 0.5 : 0.0); },
      0.05);
  int ways = 0;
  for (int k = 0; k < 300; ++k) {
    const Vec3 p(random.Uniform(k, 1) - 0.3, random.Uniform(k, 2) - 0.5,
                 0.6 * random.Uniform(k, 3) - 0.2);
    const auto exit = FindGroundExit(ground, p);
    if (!exit) continue;
    ++ways;
    const Vec3 end = p + exit->depth_m * exit->direction_W;
    EXPECT_FALSE(FindGroundExit(ground, end + 1e-4 * Vec3::UnitZ())) << k;
    for (int other = 0; other < 100; ++other) {
      const double z = 2 * random.Uniform(other, 4) - 1,
                   around_rad = 2 * kPi * random.Uniform(other, 5);
      const Vec3 direction(std::sqrt(1 - z * z) * std::cos(around_rad),
                           std::sqrt(1 - z * z) * std::sin(around_rad), z);
      EXPECT_TRUE(FindGroundExit(ground, p + 0.999 * exit->depth_m * direction)) << k;
    }
  }
  EXPECT_GT(ways, 100);
}

}  // namespace
}  // namespace tera
