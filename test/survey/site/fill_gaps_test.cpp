#include "survey/site/fill_gaps.h"

#include <gtest/gtest.h>

#include <limits>

namespace tera {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

TEST(FillGaps, CarriesAPlaneThroughAHole) {
  const CellGrid grid = {.low_m = Vec2(100, 200), .cell_m = 0.5, .nx = 60, .ny = 40};
  const auto plane = [&](int i, int j) {
    const Vec2 at = grid.MiddleOf(i, j);
    return 400 + 0.1 * at.x() - 0.2 * at.y();
  };
  std::vector<float> height_m(grid.size());
  for (int j = 0; j < grid.ny; ++j) {
    for (int i = 0; i < grid.nx; ++i) {
      const bool hole = i > 10 && i < 45 && j > 5 && j < 33;
      height_m[grid.At(i, j)] = hole ? kUnknown : static_cast<float>(plane(i, j));
    }
  }
  FillGaps(grid, &height_m);
  // Heights of 400 m are kept to 30 um.
  for (int j = 0; j < grid.ny; ++j) {
    for (int i = 0; i < grid.nx; ++i) {
      EXPECT_NEAR(height_m[grid.At(i, j)], plane(i, j), 2e-4) << i << " " << j;
    }
  }
}

TEST(FillGaps, RunsOutLevelBeyondTheLastKnownColumn) {
  const CellGrid grid = {.cell_m = 1, .nx = 20, .ny = 5};
  std::vector<float> height_m(grid.size(), kUnknown);
  for (int j = 0; j < grid.ny; ++j) {
    for (int i = 0; i < 3; ++i) height_m[grid.At(i, j)] = static_cast<float>(i);
  }
  FillGaps(grid, &height_m);
  for (int i = 3; i < grid.nx; ++i) EXPECT_NEAR(height_m[grid.At(i, 2)], 2, 1e-3) << i;
}

}  // namespace
}  // namespace tera
