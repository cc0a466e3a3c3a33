#include "render/ground/ground_light.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace tera {
namespace {

constexpr double kCell_m = 0.1;
constexpr int kSide = 41;  // vertices
constexpr int kWall = 30;  // column of a wall one cell thick
constexpr float kWall_m = 1.0f;

TerrainSurface FlatGround() {
  return TerrainSurface({.origin_W_m = Vec2::Zero(), .cell_m = kCell_m, .nx = kSide, .ny = kSide});
}

TerrainSurface GroundWithWall() {
  TerrainSurface ground = FlatGround();
  for (int j = 0; j < kSide; ++j) ground.Set(kWall, j, {.height_m = kWall_m, .cover = {}});
  return ground;
}

HeightTexels Texels(const TerrainSurface& ground) {
  HeightTexels texels(ground);
  texels.Read(ground, {0, 0, texels.width(), texels.height()});
  return texels;
}

/// Sun in the direction of +x at this elevation.
Vec3 ToSun(double elevation_rad) { return {std::cos(elevation_rad), 0, std::sin(elevation_rad)}; }

void ExpectWhole(const TexelWindow& window) {
  EXPECT_EQ(window.i0, 0);
  EXPECT_EQ(window.j0, 0);
  EXPECT_EQ(window.i1, kSide);
  EXPECT_EQ(window.j1, kSide);
}

TEST(TexelRows, HoldEachTexelOfTheirWindowsOnce) {
  // Two adjacent windows, one across both, one apart, one empty.
  const std::vector<TexelWindow> windows = {
      {0, 0, 5, 5}, {4, 0, 9, 5}, {2, 3, 7, 8}, {12, 1, 14, 2}, {3, 3, 3, 9}};
  std::map<std::pair<int, int>, int> rows;
  for (const TexelRow& row : RowsOf(windows)) {
    for (int i = row.i0; i < row.i1; ++i) ++rows[{i, row.j}];
  }
  for (int j = -1; j < 10; ++j) {
    for (int i = -1; i < 16; ++i) {
      const bool is_held = std::any_of(windows.begin(), windows.end(), [&](const TexelWindow& w) {
        return i >= w.i0 && i < w.i1 && j >= w.j0 && j < w.j1;
      });
      EXPECT_EQ((rows[{i, j}]), is_held ? 1 : 0) << i << " " << j;
    }
  }
}

TEST(TexelWindows, AreGatheredWhereLittleLiesBetween) {
  const std::vector<TexelWindow> windows = {
      {0, 0, 10, 10}, {10, 0, 20, 10}, {3, 3, 3, 3}, {500, 500, 510, 510}, {0, 10, 20, 12}};
  const std::vector<TexelWindow> gathered = Gathered(windows, 50);
  ASSERT_EQ(gathered.size(), 2u);  // a strip of three, and one far off
  const auto is = [](const TexelWindow& w, int i0, int j0, int i1, int j1) {
    return w.i0 == i0 && w.j0 == j0 && w.i1 == i1 && w.j1 == j1;
  };
  EXPECT_TRUE(is(gathered[0], 500, 500, 510, 510) || is(gathered[1], 500, 500, 510, 510));
  EXPECT_TRUE(is(gathered[0], 0, 0, 20, 12) || is(gathered[1], 0, 0, 20, 12));
}

TEST(GroundShadow, IsKnownEverywhereAfterTheFirstUpdate) {
  // At height 0 the sunny border has the previous value of the memory.
  for (const Vec3& to_sun_W : {ToSun(0.7), Vec3(-0.3, -0.8, 0.5), Vec3(0.1, 0.9, 0.4)}) {
    GroundShadow shadow(to_sun_W.normalized());
    ExpectWhole(shadow.Update(Texels(FlatGround()), {}));
  }
}

TEST(GroundShadow, OfNothingWhereNothingChanged) {
  GroundShadow shadow(ToSun(0.7));
  const HeightTexels texels = Texels(FlatGround());
  shadow.Update(texels, {});
  EXPECT_TRUE(shadow.Update(texels, {0, 0, kSide, kSide}).empty());
}

TEST(GroundShadow, BehindAWallFallsByTheTangentOfTheSunsElevation) {
  const double elevation_rad = 0.5;
  GroundShadow shadow(ToSun(elevation_rad));
  const HeightTexels texels = Texels(GroundWithWall());
  shadow.Update(texels, {});
  for (int i = 0; i < kSide; ++i) {
    const double behind_m = (kWall - i) * kCell_m;
    const double top_m = kWall_m - behind_m * std::tan(elevation_rad);
    const float shadow_m = shadow.shadow_m()[texels.index(i, kSide / 2)];
    if (i < kWall && top_m > 0) {
      EXPECT_NEAR(shadow_m, top_m, 1e-5) << i;
    } else {
      EXPECT_LT(shadow_m, texels.at(i, kSide / 2)) << i << ", in the sun";
    }
  }
}

TEST(GroundShadow, AfterADigIsThatOfTheDugGroundFromTheBeginning) {
  const Vec3 to_sun_W = Vec3(0.8, 0.35, 0.45).normalized();
  TerrainSurface ground = GroundWithWall();
  HeightTexels texels = Texels(ground);
  GroundShadow shadow(to_sun_W);
  shadow.Update(texels, {});
  const TexelWindow hole{kWall - 1, 12, kWall + 2, 20};
  for (int j = hole.j0; j < hole.j1; ++j) {
    for (int i = hole.i0; i < hole.i1; ++i) ground.Set(i, j, {.height_m = -0.4f, .cover = {}});
  }
  texels.Read(ground, hole);
  const TexelWindow shaded = shadow.Update(texels, hole);
  GroundShadow fresh(to_sun_W);
  fresh.Update(Texels(ground), {});
  EXPECT_EQ(shadow.shadow_m(), fresh.shadow_m());
  EXPECT_LT(shaded.i0, hole.i0) << "the light that falls through the gap reaches beyond it";
}

TEST(SkyView, OfLevelGroundIsWhole) {
  const HeightTexels texels = Texels(FlatGround());
  EXPECT_FLOAT_EQ(SkyView(kCell_m).Factor(texels, 20, 20), 1.0f);
}

// Also at borders, with samples beyond them, and over more texels than one batch.
TEST(SkyView, OfARowIsThatOfEachOfItsTexels) {
  TerrainSurface ground({.origin_W_m = Vec2::Zero(), .cell_m = kCell_m, .nx = 181, .ny = 61});
  for (int j = 0; j < ground.ny; ++j) {
    for (int i = 0; i < ground.nx; ++i) {
      const double height_m = 0.3 * std::sin(0.3 * i) * std::cos(0.4 * j) + 0.1 * std::sin(2.0 * i);
      ground.Set(i, j, {.height_m = static_cast<float>(height_m), .cover = {}});
    }
  }
  const HeightTexels texels = Texels(ground);
  const SkyView sky(kCell_m);
  for (const TexelRow& row : {TexelRow{30, 0, 181},
                              {2, 0, 181},
                              {60, 5, 90},
                              {31, 20, 21},
                              {30, 40, 130},
                              {29, 0, 3},
                              {28, 175, 181}}) {
    std::vector<float> factors(static_cast<std::size_t>(row.i1 - row.i0));
    sky.Factors(texels, row, factors.data());
    for (int i = row.i0; i < row.i1; ++i) {
      EXPECT_EQ(factors[static_cast<std::size_t>(i - row.i0)], sky.Factor(texels, i, row.j))
          << i << " " << row.j;
    }
  }
}

TEST(SkyView, AtTheFootOfAWallIsClosedInThreeOfEightDirections) {
  const HeightTexels texels = Texels(GroundWithWall());
  // cos2 of the horizon of a wall, seen from one cell away, straight ahead and obliquely.
  const double ahead = 1 / (1 + std::pow(kWall_m / kCell_m, 2));
  const double aslant = 1 / (1 + std::pow(kWall_m / (kCell_m * std::sqrt(2)), 2));
  const double expected = (5 + ahead + 2 * aslant) / 8;
  EXPECT_NEAR(SkyView(kCell_m).Factor(texels, kWall - 1, 20), expected, 1e-3);
}

}  // namespace
}  // namespace tera
