#include "core/terrain_surface.h"

#include <gtest/gtest.h>

namespace tera {
namespace {

/// 3 x 2 vertices half a metre apart, lower left at (10, -1).
TerrainSurface Small() {
  TerrainSurface s;
  s.origin_W_m = Vec2(10, -1);
  s.cell_m = 0.5;
  s.nx = 3;
  s.ny = 2;
  s.height_m = {0, 1, 1,  //
                2, 4, 1};
  return s;
}

TEST(TerrainSurface, HeightFollowsTheTwoTrianglesOfASquare) {
  const TerrainSurface s = Small();
  EXPECT_NEAR(s.HeightAt(10.25, -1.0), 0.5, 1e-6);     // on the lower edge
  EXPECT_NEAR(s.HeightAt(10.25, -0.75), 2.0, 1e-6);    // on the diagonal from 0 to 4
  EXPECT_NEAR(s.HeightAt(10.375, -0.875), 1.5, 1e-6);  // lower right: 0 + 0.75 * 1 + 0.25 * 3
  EXPECT_NEAR(s.HeightAt(10.125, -0.625), 2.0, 1e-6);  // upper left: 0 + 0.75 * 2 + 0.25 * 2
}

TEST(TerrainSurface, HoldsItsBorderOutside) {
  EXPECT_NEAR(Small().HeightAt(0, -50), 0.0, 1e-6);
  EXPECT_NEAR(Small().HeightAt(99, 99), 1.0, 1e-6);
}

TEST(TerrainSurface, NormalStandsOnTheTriangle) {
  // Lower right triangle of the first square: slope 1/0.5 along x, 3/0.5 along y.
  const Vec3 n = Small().NormalAt(10.4, -0.95);
  EXPECT_NEAR(n.x() / n.z(), -2.0, 1e-6);
  EXPECT_NEAR(n.y() / n.z(), -6.0, 1e-6);
  EXPECT_NEAR(n.norm(), 1.0, 1e-12);
}

TEST(TerrainSurface, CountsTilesByTheirSquares) {
  TerrainSurface s;
  s.nx = 101;
  s.ny = 52;
  EXPECT_EQ(s.tiles_x(), 2);
  EXPECT_EQ(s.tiles_y(), 2);
}

}  // namespace
}  // namespace tera
