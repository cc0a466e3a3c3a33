#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "soil/soil_fixture.h"

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
  const auto soil = MakeGround(kLargeSite);
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

/// Sand that the compact bucket has dug along a path, on a site of its own.
std::unique_ptr<Soil> Dug(const std::string& size_m, const BucketPath& path) {
  auto soil = MakeGround("size_m: " + size_m + "\nsoil: sand\n");
  GroundTools tools;
  tools.shovels = {CompactBucket()};
  const int machine = soil->AddMachine(tools);
  RunBucket(soil.get(), machine, path, [](double, const BodyState&, const SoilReaction&) {});
  for (int k = 0; k < 1500; ++k) soil->Flow(kStep_s);
  return soil;
}

TEST(LargeSite, TheSameCutOnASiteOfAnySizeLeavesTheSameGround) {
  // Into the ground and along it, not out of it. Places round otherwise on another site, and the
  // flow is sensitive to the place where a clod falls.
  const BucketPath cut({{0.0, {0.3, 0, 1.28}, 80 * kDeg},
                        {1.0, {0.3, 0, 0.58}, 85 * kDeg},
                        {2.5, {-0.5, 0, 0.56}, 105 * kDeg}});
  const auto small = Dug("[40, 40]", cut), large = Dug("[500, 500]", cut);
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

/// Traces of a dig: the missing soil, and the heap where the bucket was dumped.
struct HoleAndHeap {
  explicit HoleAndHeap(const TerrainSurface& ground) {
    for (double y_m = -2.5; y_m < 5; y_m += ground.cell_m) {
      for (double x_m = -3.5; x_m < 2.5; x_m += ground.cell_m) {
        const double z_m = ground.HeightAt(x_m, y_m), area_m2 = ground.cell_m * ground.cell_m;
        hole_m3 += std::max(0.0, -z_m) * area_m2;
        deepest_m = std::max(deepest_m, -z_m);
        if (y_m < 1.5) continue;
        heap_m3 += std::max(0.0, z_m) * area_m2;
        highest_m = std::max(highest_m, z_m);
      }
    }
  }
  double hole_m3 = 0, deepest_m = 0, heap_m3 = 0, highest_m = 0;
};

TEST(LargeSite, AWholeDigOnASiteOfAnySizeLeavesAHoleAndAHeapAlike) {
  // As deep and as high to 2 mm, of the same volumes to 1 %, whatever places clods round to.
  const HoleAndHeap small(Dug("[40, 40]", DigCycle(0.25))->surface());
  const HoleAndHeap large(Dug("[500, 500]", DigCycle(0.25))->surface());
  EXPECT_GT(small.hole_m3, 0.05);
  EXPECT_GT(small.heap_m3, 0.05);
  EXPECT_NEAR(large.hole_m3 / small.hole_m3, 1, 0.01);
  EXPECT_NEAR(large.heap_m3 / small.heap_m3, 1, 0.01);
  EXPECT_NEAR(large.deepest_m, small.deepest_m, 0.002);
  EXPECT_NEAR(large.highest_m, small.highest_m, 0.002);
}

}  // namespace
}  // namespace tera
