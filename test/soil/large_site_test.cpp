#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "soil_fixture.h"

// A site of 500 x 500 m at 5 cm: a hundred million columns, of which a machine touches few.

namespace tera {
namespace {

using namespace testing_soil;

constexpr char kLargeSite[] =
    "size_m: [500, 500]\n"
    "relief: {slope_deg: 2, slope_direction_deg: 40}\n"
    "layers:\n"
    "  - {soil: dirt, from_m: 0, to_m: 0.3}\n"
    "  - {soil: sand, from_m: 0.3}\n"
    "regions: [{outline_m: [[30, 30], [90, 40], [60, 80]], soil: gravel}]\n";

struct Tile {
  int a, b;
};

/// Tiles that have vertices of their own.
std::vector<Tile> RefinedTiles(const TerrainSurface& ground) {
  std::vector<Tile> tiles;
  for (int b = 0; b < ground.tiles_y(); ++b) {
    for (int a = 0; a < ground.tiles_x(); ++a) {
      if (ground.IsRefined(a, b)) tiles.push_back({a, b});
    }
  }
  return tiles;
}

/// Drives two tracks 6 m along x at y = 5 m, 2 cm in the ground.
void Drive(Soil* soil, int machine) {
  constexpr double kSpeed_mps = 1.0, kSunk_m = 0.02;
  for (int k = 0; k < 3000; ++k) {
    const double x_m = -3 + k * kStep_s * kSpeed_mps;
    const Vec3 p_m(x_m, 5, soil->surface().HeightAt(x_m, 5) - kSunk_m);
    const std::vector<BodyState> links = {
        {.X_WB = MakePose(p_m), .v_WB_mps = Vec3(kSpeed_mps, 0, 0)}};
    GroundToolsMotion motion;
    motion.links = &links;
    motion.gear_rate_radps = {kSpeed_mps / 0.25, kSpeed_mps / 0.25};
    soil->Act(machine, motion, kStep_s);
    soil->Flow(kStep_s);
  }
}

TEST(LargeSite, OnlyTilesThatAMachineReachedHaveColumns) {
  const auto soil = MakeSite(kLargeSite);
  const TerrainSurface& ground = soil->surface();
  ASSERT_EQ(ground.nx, 10001);
  ASSERT_EQ(ground.tile_count(), 200 * 200);
  const std::vector<Tile> at_start = RefinedTiles(ground);
  // The region's outline, 190 m long, crosses a tile each 2.5 m at most 1.5 times.
  EXPECT_LT(at_start.size(), 1.5 * 190 / 2.5 * 3);
  std::vector<std::uint32_t> version;
  for (int k = 0; k < ground.tile_count(); ++k) {
    version.push_back(ground.tile_version(k % 200, k / 200));
  }

  GroundTools tools;
  tools.shovels = {CompactBucket()};
  const int digger = soil->AddMachine(tools);
  RunBucket(soil.get(), digger, DigCycle(0.25),
            [](double, const BodyState&, const SoilReaction&) {});
  GroundTools tracks;
  tracks.gears = {FlatTrack(-0.6, 1.6, 0.3, 6), FlatTrack(0.6, 1.6, 0.3, 6)};
  Drive(soil.get(), soil->AddMachine(tracks));

  // Tracks end at x = 3.8 m, y = 4.25 to 5.75 m; the bucket's work lies within 2 m of x = 0, y = 0
  // to 2.5 m. One tile of 2.5 m more each way.
  int touched = 0;
  for (int b = 0; b < ground.tiles_y(); ++b) {
    for (int a = 0; a < ground.tiles_x(); ++a) {
      if (ground.tile_version(a, b) == version[ground.tile_index(a, b)]) continue;
      ++touched;
      const double x_m = ground.x_m(a * TerrainGrid::kTileCells);
      const double y_m = ground.y_m(b * TerrainGrid::kTileCells);
      EXPECT_TRUE(x_m > -9 && x_m < 6.5 && y_m > -7 && y_m < 8.5) << x_m << ' ' << y_m;
    }
  }
  EXPECT_GE(touched, 5);
  EXPECT_LE(touched, 30);  // of 40 000
  EXPECT_LE(RefinedTiles(ground).size(), at_start.size() + 30);
  EXPECT_NEAR(soil->ledger().total_kg(), 0, 1e-9 * soil->ledger().shifted_kg);
}

TEST(LargeSite, TheSameCutOnASiteOfAnySizeLeavesTheSameGround) {
  // Into the ground and along it, not out of it: places round otherwise on another site, and where
  // a clod falls decides by a hair's breadth what flows.
  const BucketPath cut({{0.0, {0.3, 0, 1.28}, 80 * kDeg},
                        {1.0, {0.3, 0, 0.58}, 85 * kDeg},
                        {2.5, {-0.5, 0, 0.56}, 105 * kDeg}});
  const auto dug = [&](const std::string& size) {
    auto soil = MakeSite("size_m: " + size + "\nsoil: sand\n");
    GroundTools tools;
    tools.shovels = {CompactBucket()};
    const int machine = soil->AddMachine(tools);
    RunBucket(soil.get(), machine, cut, [](double, const BodyState&, const SoilReaction&) {});
    return soil;
  };
  const auto small = dug("[40, 40]"), large = dug("[500, 500]");
  const int shift = (10001 - 801) / 2;
  int changed = 0;
  for (int j = 340; j < 480; ++j) {
    for (int i = 340; i < 480; ++i) {
      const double height_m = small->surface().height_m(i, j);
      ASSERT_NEAR(height_m, large->surface().height_m(i + shift, j + shift), 1e-6) << i << ' ' << j;
      changed += height_m != 0;
    }
  }
  EXPECT_GT(changed, 200);
}

}  // namespace
}  // namespace tera
