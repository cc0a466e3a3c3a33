#include "survey/site/survey_site.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <memory>

#include "core/faults.h"
#include "own_folder.h"
#include "soil/site/survey_raster.h"
#include "survey/survey_files.h"
#include "survey/surveyed_yard.h"

// A survey of a known yard: its ground, and the objects on it.

namespace tera {
namespace {

using namespace testing_survey;
namespace fs = std::filesystem;

fs::path File(const std::string& name) { return OwnFolder() / name; }

class YardSite : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    WriteBytes(File("yard.ply"), PlyOf(YardScanner(7).Scan(0.1)));
    SiteRequest request;
    request.origin.height_m = 0;
    site_ = std::make_unique<SurveySite>(MakeSurveySite(File("yard.ply"), request));
  }
  static void TearDownTestSuite() { site_.reset(); }

  template <typename Visit>
  static void ForCells(Visit visit) {
    const SurveyTerrain& terrain = site_->terrain;
    for (int j = 0; j < terrain.grid.ny; ++j) {
      for (int i = 0; i < terrain.grid.nx; ++i) {
        const std::size_t cell = terrain.grid.At(i, j);
        visit(terrain.grid.MiddleOf(i, j), terrain.height_m[cell], terrain.source[cell]);
      }
    }
  }

  static std::unique_ptr<SurveySite> site_;
};

std::unique_ptr<SurveySite> YardSite::site_;

bool NearTrenchWall(const Vec2& at, double margin_m) {
  const Vec2 margin(margin_m, margin_m);
  const bool outside = (at.array() > (kTrenchLow_m - margin).array()).all() &&
                       (at.array() < (kTrenchHigh_m + margin).array()).all();
  const bool inside = (at.array() > (kTrenchLow_m + margin).array()).all() &&
                      (at.array() < (kTrenchHigh_m - margin).array()).all();
  return outside && !inside;
}

// One point lies anywhere in each square of 0.1 m, which is the finest cell size with points in
// half of the cells. Noise of 10 mm moves 4 x 0.01 / (0.1 sqrt(2 pi)) = 16 % of them over a side,
// so that some 13 % of the cells stay empty. A cell's height thus errs by the point's noise (10 mm)
// and by the slope times its place in the cell: 0.05 x 0.05 m on the plane, at most tan 35 deg x
// 0.071 m = 50 mm on the pile.
TEST_F(YardSite, HeightsAreThoseOfTheGround) {
  EXPECT_DOUBLE_EQ(site_->terrain.grid.cell_m, 0.1);
  double squares_m2 = 0;
  int cells = 0;
  ForCells([&](const Vec2& at, float height_m, HeightSource source) {
    if (source != HeightSource::kMeasured || NearTrenchWall(at, 0.2)) return;
    const double error_m = height_m - GroundAt(at);
    const bool on_pile = (at - kPile_m).norm() < kPileRadius_m + 0.1;
    // Five standard deviations of the noise.
    EXPECT_LT(std::abs(error_m), on_pile ? 0.11 : 0.06) << at.transpose();
    if (on_pile) return;
    squares_m2 += error_m * error_m;
    ++cells;
  });
  EXPECT_GT(cells, 95'000);  // 120 000 minus objects, hole, pile and empty cells
  EXPECT_LT(std::sqrt(squares_m2 / cells), 1.1 * kNoise_m);
}

TEST_F(YardSite, PileAndTrenchKeepTheirVolumes) {
  const double area_m2 = site_->terrain.grid.cell_m * site_->terrain.grid.cell_m;
  double pile_m3 = 0, trench_m3 = 0;
  ForCells([&](const Vec2& at, float height_m, HeightSource) {
    const double above_m = height_m - kRise * at.x();
    if ((at - kPile_m).norm() < kPileRadius_m + 0.3) pile_m3 += area_m2 * above_m;
    const Vec2 margin(0.5, 0.5);
    if ((at.array() > (kTrenchLow_m - margin).array()).all() &&
        (at.array() < (kTrenchHigh_m + margin).array()).all()) {
      trench_m3 -= area_m2 * above_m;
    }
  });
  const double cone_m3 = std::numbers::pi * kPileRadius_m * kPileRadius_m * kPileHeight_m / 3;
  EXPECT_NEAR(pile_m3, cone_m3, 0.02 * cone_m3);
  const Vec2 size_m = kTrenchHigh_m - kTrenchLow_m;
  const double dug_m3 = size_m.prod() * kTrenchDepth_m;
  EXPECT_NEAR(trench_m3, dug_m3, 0.03 * dug_m3);
}

TEST_F(YardSite, AHoleIsMarkedAndFilledWithThePlaneAroundIt) {
  int inside = 0, around = 0, measured = 0;
  ForCells([&](const Vec2& at, float height_m, HeightSource source) {
    const double from_m = (at - kHole_m).norm();
    if (from_m < kHoleRadius_m - 0.15) {
      EXPECT_EQ(source, HeightSource::kFilled) << at.transpose();
      // The membrane's border is noisy by 10 mm a cell, and it smooths.
      EXPECT_NEAR(height_m, GroundAt(at), 0.03) << at.transpose();
      ++inside;
    } else if (from_m < kHoleRadius_m + 2 && from_m > kHoleRadius_m + 0.15) {
      ++around;
      measured += source == HeightSource::kMeasured ? 1 : 0;
    }
  });
  EXPECT_GT(inside, 500);
  EXPECT_GT(measured, 0.8 * around);
  EXPECT_EQ(site_->terrain.CountOf(HeightSource::kBeyondSurvey), 0);
}

TEST_F(YardSite, GroundUnderThingsIsMarked) {
  for (const YardBox& box : kBoxes) {
    const CellGrid& grid = site_->terrain.grid;
    const std::size_t cell = grid.At(grid.Column(box.at_m.x()), grid.Row(box.at_m.y()));
    EXPECT_EQ(site_->terrain.source[cell], HeightSource::kUnderThing) << box.at_m.transpose();
    EXPECT_NEAR(site_->terrain.height_m[cell], GroundAt(box.at_m), 0.05) << box.at_m.transpose();
  }
}

// The outermost of some hundred points on each face are off by up to three standard deviations.
TEST_F(YardSite, EachThingIsFoundWithItsSizeAndNoneIsInvented) {
  ASSERT_EQ(site_->things.size(), kBoxes.size());
  for (std::size_t k = 0; k < kBoxes.size(); ++k) {  // both are in the order of their volumes
    const YardBox& box = kBoxes[k];
    const SurveyThing& thing = site_->things[k];
    EXPECT_LT((thing.footprint.middle_m - box.at_m).norm(), 0.05) << k;
    EXPECT_NEAR(thing.footprint.length_m, box.size_m.x(), 0.1) << k;
    EXPECT_NEAR(thing.footprint.width_m, box.size_m.y(), 0.1) << k;
    EXPECT_NEAR(thing.top_m - thing.ground_m, box.size_m.z(), 0.08) << k;
    if (box.size_m.x() < 1.1 * box.size_m.y()) continue;  // a square has no unique yaw
    const double off_rad = std::remainder(thing.footprint.yaw_rad - box.yaw_rad, std::numbers::pi);
    EXPECT_LT(std::abs(off_rad), 0.06 / box.size_m.y()) << k;
  }
}

TEST_F(YardSite, WhatStandsAloneIsLeftOut) {
  EXPECT_GE(site_->outliers, 54);  // of 60, some of them near an object
  EXPECT_LE(site_->outliers, 70);
}

TEST(SurveySite, OfARasterHasItsPixelsAndItsGaps) {
  const auto map = ReadMapReference("here", "EPSG:32632");
  const MapSquares squares = {Vec2(691'000.17, 5'335'000.29), 0.3, 50, 40};
  std::vector<float> height_m;
  for (int j = 0; j < squares.ny; ++j) {
    for (int i = 0; i < squares.nx; ++i) {
      const bool gap = i > 20 && i < 25 && j > 10 && j < 16;
      height_m.push_back(gap ? std::numeric_limits<float>::quiet_NaN()
                             : 500.0F + 0.02F * static_cast<float>(i) +
                                   0.1F * std::sin(0.4F * static_cast<float>(j)));
    }
  }
  WriteHeights(File("dem.tif"), squares, height_m, *map);
  const SurveySite site = MakeSurveySite(File("dem.tif"), {});
  const CellGrid& grid = site.terrain.grid;
  EXPECT_DOUBLE_EQ(grid.cell_m, 0.3);
  ASSERT_EQ(grid.nx, squares.nx);
  ASSERT_EQ(grid.ny, squares.ny);
  EXPECT_LT((grid.low_m - squares.low_m).norm(), 1e-6);
  for (std::size_t k = 0; k < height_m.size(); ++k) {
    if (std::isnan(height_m[k])) {
      EXPECT_EQ(site.terrain.source[k], HeightSource::kFilled);
    } else {
      EXPECT_FLOAT_EQ(site.terrain.height_m[k], height_m[k]);
    }
  }
  EXPECT_TRUE(site.things.empty());
  EXPECT_EQ(site.map.name, map->name);
}

TEST(SurveySite, RefusesWhatCannotBecomeASite) {
  const auto faults = [](const std::vector<Vec3>& p_m, std::optional<double> cell_m) {
    WriteBytes(File("bad.ply"), PlyOf(p_m));
    SiteRequest request;
    request.cell_m = cell_m;
    return FaultsIn([&] { MakeSurveySite(File("bad.ply"), request); });
  };
  std::vector<Vec3> grid, wide;
  for (int j = 0; j < 40; ++j) {
    for (int i = 0; i < 40; ++i) {
      grid.emplace_back(0.5 * i, 0.5 * j, 0.01 * ((i * 7 + j * 3) % 5));
      wide.emplace_back(250.0 * i, 250.0 * j, 0);
    }
  }
  EXPECT_THAT(faults(grid, 0.05), HasFault(FaultKind::kOutOfRange, "bad.ply"));
  std::vector<Vec3> y_up;
  for (const Vec3& p : grid) y_up.emplace_back(p.x(), p.z(), -p.y());
  EXPECT_THAT(faults(y_up, {}), HasFault(FaultKind::kInconsistent, "bad.ply"));
  EXPECT_THAT(faults(wide, 0.01), HasFault(FaultKind::kOutOfRange, "bad.ply"));
  EXPECT_THAT(faults({{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}}, 0.1),
              HasFault(FaultKind::kOutOfRange, "bad.ply"));
}

}  // namespace
}  // namespace tera
