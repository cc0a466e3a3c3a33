#include "sim/state/terrain_changes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/state/changing_ground.h"

namespace tera {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TerrainSurface::Vertex Raised(const TerrainSurface& ground, int i, int j, float by_m) {
  TerrainSurface::Vertex vertex = ground.at(i, j);
  vertex.height_m += by_m;
  return vertex;
}

TEST(TerrainChanges, OfGroundThatRestsThereIsNone) {
  const TerrainSurface ground = UnevenGround();
  TerrainTracker tracker(ground);
  for (int k = 0; k < 3; ++k) {
    const TerrainChange change = tracker.Find(ground);
    EXPECT_THAT(change.refined_tiles, IsEmpty());
    EXPECT_THAT(change.vertices, IsEmpty());
    EXPECT_THAT(change.grains, IsEmpty());
    tracker.Accept(change);
  }
}

TEST(TerrainChanges, OneVertexWithinATileIsOneChange) {
  TerrainSurface ground = UnevenGround();
  TerrainTracker tracker(ground);
  ground.Set(60, 70, Raised(ground, 60, 70, 0.25f));
  const TerrainChange change = tracker.Find(ground);
  EXPECT_THAT(change.refined_tiles, ElementsAre(ground.tile_index(1, 1)));
  ASSERT_EQ(change.vertices.size(), 1u);
  EXPECT_EQ(change.vertices[0].i, 60);
  EXPECT_EQ(change.vertices[0].j, 70);
  EXPECT_EQ(change.vertices[0].vertex, ground.at(60, 70));
  tracker.Accept(change);
  EXPECT_EQ(Difference(tracker.known(), ground), "");
  EXPECT_THAT(tracker.Find(ground).vertices, IsEmpty());
}

TEST(TerrainChanges, WhatIsNotAcceptedIsFoundAgain) {
  TerrainSurface ground = UnevenGround();
  TerrainTracker tracker(ground);
  ground.Set(3, 4, Raised(ground, 3, 4, 0.25f));
  const TerrainChange first = tracker.Find(ground);
  ground.Set(3, 4, Raised(ground, 3, 4, 0.25f));
  tracker.Accept(first);
  const TerrainChange second = tracker.Find(ground);
  ASSERT_EQ(second.vertices.size(), 1u);
  EXPECT_EQ(second.vertices[0].vertex, ground.at(3, 4));
}

TEST(TerrainChanges, VerticesOnBordersAndCornersOfTilesAreFoundOnce) {
  TerrainSurface ground = UnevenGround();
  TerrainTracker tracker(ground);
  const std::pair<int, int> places[] = {{0, 0},   {117, 162}, {117, 0}, {0, 162},   {50, 20},
                                        {20, 50}, {50, 50},   {100, 1}, {100, 150}, {49, 49},
                                        {51, 51}, {117, 100}, {50, 162}};
  for (const auto& [i, j] : places) ground.Set(i, j, Raised(ground, i, j, 0.5f));
  const TerrainChange change = tracker.Find(ground);
  EXPECT_EQ(change.vertices.size(), std::size(places));
  tracker.Accept(change);
  EXPECT_EQ(Difference(tracker.known(), ground), "");
}

TEST(TerrainChanges, ATileThatIsRefinedWithoutAnotherChangeIsOne) {
  TerrainSurface ground = UnevenGround();
  TerrainTracker tracker(ground);
  ground.Refine(2, 1);
  const TerrainChange change = tracker.Find(ground);
  EXPECT_THAT(change.refined_tiles, ElementsAre(ground.tile_index(2, 1)));
  EXPECT_THAT(change.vertices, IsEmpty());
  tracker.Accept(change);
  EXPECT_EQ(Difference(tracker.known(), ground), "");
}

TEST(TerrainChanges, ACoverAloneIsAChange) {
  TerrainSurface ground = UnevenGround();
  ground.Refine(0, 0);
  TerrainTracker tracker(ground);
  for (auto member : {&TerrainSurface::Cover::soil, &TerrainSurface::Cover::moisture,
                      &TerrainSurface::Cover::looseness, &TerrainSurface::Cover::rut}) {
    TerrainSurface::Vertex vertex = ground.at(7, 8);
    vertex.cover.*member ^= 0x80;
    ground.Set(7, 8, vertex);
    const TerrainChange change = tracker.Find(ground);
    ASSERT_EQ(change.vertices.size(), 1u);
    tracker.Accept(change);
    EXPECT_EQ(Difference(tracker.known(), ground), "");
  }
}

TEST(TerrainChanges, AVertexSetToWhatItIsDoesNotChange) {
  TerrainSurface ground = UnevenGround();
  ground.Refine(0, 0);
  TerrainTracker tracker(ground);
  ground.Set(7, 8, ground.at(7, 8));
  EXPECT_THAT(tracker.Find(ground).vertices, IsEmpty());
}

TEST(TerrainChanges, FollowsWhateverHappens) {
  for (const auto& [nx, ny, base_cells] :
       {std::tuple{118, 163, 10}, {51, 51, 50}, {52, 101, 25}, {2, 2, 1}, {3, 160, 5}}) {
    TerrainSurface ground = UnevenGround(nx, ny, base_cells), told = ground;
    TerrainTracker tracker(ground);
    GroundAtWork work(static_cast<std::uint32_t>(nx));
    for (int k = 0; k < 120; ++k) {
      work.Step(&ground);
      const TerrainChange change = tracker.Find(ground);
      tracker.Accept(change);
      Apply(change, &told);
      ASSERT_EQ(Difference(told, ground), "") << nx << " x " << ny << ", step " << k;
      ASSERT_EQ(Difference(tracker.known(), ground), "") << nx << " x " << ny << ", step " << k;
    }
  }
}

TEST(TerrainChanges, EveryTileThatChangesGetsAnotherVersion) {
  TerrainSurface ground = UnevenGround(), told = ground;
  TerrainTracker tracker(ground);
  GroundAtWork work(3);
  for (int k = 0; k < 60; ++k) {
    const TerrainSurface before = told;
    work.Step(&ground);
    const TerrainChange change = tracker.Find(ground);
    tracker.Accept(change);
    Apply(change, &told);
    for (int b = 0; b < ground.tiles_y(); ++b) {
      for (int a = 0; a < ground.tiles_x(); ++a) {
        // Changes of a tile, with its border.
        bool changes = before.IsRefined(a, b) != told.IsRefined(a, b);
        for (int j = 50 * b; j <= std::min(50 * b + 50, ground.ny - 1); ++j) {
          for (int i = 50 * a; i <= std::min(50 * a + 50, ground.nx - 1); ++i) {
            changes = changes || !(before.at(i, j) == told.at(i, j));
          }
        }
        if (changes) {
          EXPECT_NE(told.tile_version(a, b), before.tile_version(a, b)) << a << " " << b;
        }
        if (told.tile_version(a, b) != before.tile_version(a, b)) {
          EXPECT_FALSE(change.refined_tiles.empty() && change.vertices.empty());
        }
      }
    }
  }
}

TEST(TerrainChanges, HeightsThatAreNoNumbersAreKept) {
  TerrainSurface ground = UnevenGround();
  TerrainTracker tracker(ground);
  ground.Set(7, 8, {std::numeric_limits<float>::infinity(), {}});
  ground.Set(9, 8, {std::numeric_limits<float>::denorm_min(), {}});
  ground.Set(10, 8, {-std::numeric_limits<float>::max(), {}});
  tracker.Accept(tracker.Find(ground));
  EXPECT_EQ(Difference(tracker.known(), ground), "");
}

TEST(TerrainChanges, TheOtherSignOfZeroIsAnotherHeight) {
  TerrainSurface ground = UnevenGround();
  ground.Set(7, 8, {0.0f, {}});
  TerrainTracker tracker(ground);
  ground.Set(7, 8, {-0.0f, {}});
  tracker.Accept(tracker.Find(ground));
  EXPECT_EQ(Difference(tracker.known(), ground), "");
}

}  // namespace
}  // namespace tera
