#include "render/ground/ground_paint.h"

#include <gtest/gtest.h>

namespace tera {
namespace {

TEST(GroundPaint, GivesWayToTheSoilWhereTheGroundIsLooseOrHasMoved) {
  const GroundPaint paint{.low_W_m = Vec2(1, 2),
                          .cell_m = 2,
                          .nx = 2,
                          .ny = 2,
                          .albedo = {{0, 0, 0}, {1, 0, 0}, {0, 0, 0}, {1, 0, 0}},
                          .start_m = {5, 6, 5, 6}};
  const Vec3 soil(0.2, 0.3, 0.4);
  // A quarter of the way along x the start was 5.25 m high and the picture a quarter red.
  EXPECT_LT((paint.Over(soil, 1.5, 3, 5.25, 0) - Vec3(0.25, 0, 0)).norm(), 1e-9);
  EXPECT_LT((paint.Over(soil, 1.5, 3, 5.26, 0) - Vec3(0.25, 0, 0)).norm(), 1e-9);
  EXPECT_EQ(paint.Over(soil, 1.5, 3, 5.35, 0), soil);
  EXPECT_EQ(paint.Over(soil, 1.5, 3, 5.15, 0), soil);
  EXPECT_EQ(paint.Over(soil, 1.5, 3, 5.25, 1), soil);
  // 4 cm is halfway between 2 and 6.
  EXPECT_LT((paint.Over(soil, 1.5, 3, 5.21, 0) - 0.5 * (soil + Vec3(0.25, 0, 0))).norm(), 1e-6);
  // Beyond the grid its border continues.
  EXPECT_LT((paint.Over(soil, 90, 3, 6, 0) - Vec3(1, 0, 0)).norm(), 1e-9);
}

}  // namespace
}  // namespace tera
