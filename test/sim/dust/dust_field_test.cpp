#include "sim/dust/dust_field.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tera {
namespace {

DustGrid Box(int nx, int ny, int nz, double cell_m, double base_m = 0) {
  DustGrid grid;
  grid.origin_W_m = Vec2(-3, 7);
  grid.cell_m = cell_m;
  grid.nx = nx;
  grid.ny = ny;
  grid.nz = nz;
  grid.base_m.assign(static_cast<std::size_t>(nx) * ny, base_m);
  return grid;
}

DustAir Uniform(int layers, const Vec2& wind_W_mps, double diffusivity_m2ps) {
  return {std::vector<Vec2>(layers, wind_W_mps), std::vector<double>(layers, diffusivity_m2ps)};
}

/// Mean and variance of the fine dust's place, in metres from the grid's corner.
struct Spread {
  Vec3 mean_m, variance_m2;
};

Spread SpreadOf(const DustField& field) {
  const DustGrid& grid = field.grid();
  double sum = 0;
  Vec3 first = Vec3::Zero(), second = Vec3::Zero();
  for (int k = 0; k < grid.nz; ++k) {
    for (int j = 0; j < grid.ny; ++j) {
      for (int i = 0; i < grid.nx; ++i) {
        const double kg = field.cells_kg(0)[grid.index(i, j, k)];
        const Vec3 p_m = grid.cell_m * Vec3(i + 0.5, j + 0.5, k + 0.5);
        sum += kg;
        first += kg * p_m;
        second += kg * p_m.cwiseProduct(p_m);
      }
    }
  }
  const Vec3 mean_m = first / sum;
  return {mean_m, second / sum - mean_m.cwiseProduct(mean_m)};
}

TEST(DustField, APuffMovesWithTheWindAndSpreadsAsTheRootOfTwiceDiffusivityTimesTime) {
  // A puff in uniformly moving air: after t its middle has moved by U t, and the variance along
  // each axis has grown by 2 K t. Settling is 0.03 mm/s.
  const Vec2 wind_W_mps(2.0, -0.7);
  constexpr double kDiffusivity = 0.15, kTime_s = 6;
  DustField field(Box(72, 56, 40, 0.5), Uniform(40, wind_W_mps, kDiffusivity));
  field.Emit(Vec3(-3 + 9, 7 + 17, 10), 1.6, {1e-3, 0, 0});
  const Spread before = SpreadOf(field);
  for (int step = 0; step < 150; ++step) field.Advance(kTime_s / 150);
  const Spread after = SpreadOf(field);
  EXPECT_NEAR(after.mean_m.x() - before.mean_m.x(), wind_W_mps.x() * kTime_s, 0.02);
  EXPECT_NEAR(after.mean_m.y() - before.mean_m.y(), wind_W_mps.y() * kTime_s, 0.02);
  EXPECT_NEAR(after.mean_m.z() - before.mean_m.z(), 0, 0.01);
  const double grown_m2 = 2 * kDiffusivity * kTime_s;
  // The limited fluxes also diffuse slightly: by less than a tenth of a cell per step in total.
  EXPECT_NEAR(after.variance_m2.x() - before.variance_m2.x(), grown_m2, 0.15 * grown_m2);
  EXPECT_NEAR(after.variance_m2.y() - before.variance_m2.y(), grown_m2, 0.15 * grown_m2);
  EXPECT_NEAR(after.variance_m2.z() - before.variance_m2.z(), grown_m2, 0.02 * grown_m2);
}

TEST(DustField, WhatWasEmittedIsInTheAirOnTheGroundOrGone) {
  DustField field(Box(24, 20, 12, 0.5, 3.2),
                  NeutralAir({.speed_mps = 4, .from_rad = 0.6}, 12, 0.5));
  for (int step = 0; step < 400; ++step) {
    if (step < 100) field.Emit(Vec3(3, 12, 3.2 + 0.01 * step), 0.7, {1e-4, 3e-4, 2e-4});
    field.Advance(0.04, Vec2(0.3 * std::sin(step), 0.2));
  }
  const DustField::Budget budget = field.budget();
  for (int size = 0; size < kDustSizes; ++size) {
    const double emitted_kg = budget.emitted_kg[size];
    EXPECT_NEAR(budget.airborne_kg[size] + budget.settled_kg[size] + budget.left_kg[size],
                emitted_kg, 1e-12 * emitted_kg);
    EXPECT_GT(budget.left_kg[size], 0.3 * emitted_kg) << "the wind carries it over the border";
    EXPECT_GT(budget.settled_kg[size], 0);
    for (const double kg : field.cells_kg(size)) ASSERT_GE(kg, -1e-18);
  }
  EXPECT_GT(budget.settled_kg[2] / budget.emitted_kg[2],
            10 * budget.settled_kg[0] / budget.emitted_kg[0])
      << "coarse dust comes down first";
}

TEST(DustField, StillAirLetsEachSizeDownAtStokesSpeed) {
  DustField field(Box(6, 6, 30, 0.5), Uniform(30, Vec2::Zero(), 0));
  field.Emit(Vec3(-1.5, 8.5, 12), 1.0, {1e-3, 0, 0});
  DustField coarse(Box(6, 6, 30, 0.5), Uniform(30, Vec2::Zero(), 0));
  coarse.Emit(Vec3(-1.5, 8.5, 12), 1.0, {0, 0, 1e-3});
  const double height_m = SpreadOf(field).mean_m.z();
  for (int step = 0; step < 250; ++step) field.Advance(1), coarse.Advance(1);
  EXPECT_NEAR(height_m - SpreadOf(field).mean_m.z(), 250 * SettlingSpeed_mps(0), 1e-3);
  // Unit density and 17.3 um: 9.0 mm/s.
  EXPECT_NEAR(SettlingSpeed_mps(2), 9.0e-3, 0.2e-3);
  double first = 0;
  for (int k = 0; k < 30; ++k) {
    for (int j = 0; j < 6; ++j) {
      for (int i = 0; i < 6; ++i) {
        first += 0.5 * (k + 0.5) * coarse.cells_kg(2)[coarse.grid().index(i, j, k)] / 1e-3;
      }
    }
  }
  EXPECT_NEAR(height_m - first, 250 * SettlingSpeed_mps(2), 0.02);
}

TEST(DustField, TheWindOfTheSurfaceLayerIsThatAtTenMetres) {
  const DustAir air = NeutralAir({.speed_mps = 5, .from_rad = M_PI / 2}, 40, 0.5);
  // Layer 19 has its middle at 9.75 m: blowing from the east, towards -x.
  EXPECT_NEAR(air.wind_W_mps[19].x(), -5, 0.03);
  EXPECT_NEAR(air.wind_W_mps[19].y(), 0, 1e-12);
  EXPECT_LT(std::abs(air.wind_W_mps[0].x()), 0.6 * 5);
  // 0.4 u* z with u* = 0.263 m/s.
  EXPECT_NEAR(air.diffusivity_m2ps[19], 0.4 * 0.263 * 9.75, 0.01);
}

TEST(DustField, DustOutsideTheCellsHasLeft) {
  DustField field(Box(10, 10, 10, 0.5), Uniform(10, Vec2(1, 0), 0.1));
  field.Emit(Vec3(50, 50, 1), 0.5, {1e-3, 0, 0});
  EXPECT_DOUBLE_EQ(field.budget().left_kg[0], 1e-3);
}

}  // namespace
}  // namespace tera
