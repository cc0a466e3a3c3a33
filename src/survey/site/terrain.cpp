#include "survey/site/terrain.h"

#include <algorithm>
#include <deque>
#include <limits>

#include "survey/site/fill_gaps.h"

namespace tera {
namespace {

/// A thing with points below this height is a wall down to the ground. The ground next to it cannot
/// be told from the wall.
constexpr float kWallFoot_m = 1.0F;
/// A gap of up to twice this width belongs to the surveyed area.
constexpr double kSurveyReach_m = 1.0;

std::vector<float> MediansOfGround(const CellGrid& grid, const std::vector<Vec3>& p_m,
                                   const std::vector<float>& above_m) {
  std::vector<std::pair<std::size_t, float>> ground;
  for (std::size_t k = 0; k < p_m.size(); ++k) {
    if (above_m[k] <= 0) ground.emplace_back(grid.CellOf(p_m[k]), static_cast<float>(p_m[k].z()));
  }
  std::sort(ground.begin(), ground.end());
  std::vector<float> height_m(grid.size(), std::numeric_limits<float>::quiet_NaN());
  for (std::size_t first = 0; first < ground.size();) {
    std::size_t last = first;
    while (last < ground.size() && ground[last].first == ground[first].first) ++last;
    const std::size_t upper = first + (last - first) / 2, lower = first + (last - first - 1) / 2;
    height_m[ground[first].first] = 0.5F * (ground[lower].second + ground[upper].second);
    first = last;
  }
  return height_m;
}

std::vector<bool> Widened(const CellGrid& grid, const std::vector<bool>& cells, int reach) {
  // First along rows, then along columns, which covers a square around each cell.
  std::vector<bool> rows(grid.size(), false), both(grid.size(), false);
  for (int j = 0; j < grid.ny; ++j) {
    for (int i = 0; i < grid.nx; ++i) {
      for (int d = -reach; cells[grid.At(i, j)] && d <= reach; ++d) {
        if (grid.Has(i + d, j)) rows[grid.At(i + d, j)] = true;
      }
    }
  }
  for (int j = 0; j < grid.ny; ++j) {
    for (int i = 0; i < grid.nx; ++i) {
      for (int d = -reach; rows[grid.At(i, j)] && d <= reach; ++d) {
        if (grid.Has(i, j + d)) both[grid.At(i, j + d)] = true;
      }
    }
  }
  return both;
}

/// Cells that are connected to the border of the grid without crossing the surveyed area.
std::vector<bool> Beyond(const CellGrid& grid, const std::vector<bool>& surveyed) {
  std::vector<bool> beyond(grid.size(), false);
  std::deque<std::array<int, 2>> edge;
  const auto visit = [&](int i, int j) {
    if (!grid.Has(i, j) || surveyed[grid.At(i, j)] || beyond[grid.At(i, j)]) return;
    beyond[grid.At(i, j)] = true;
    edge.push_back({i, j});
  };
  for (int i = 0; i < grid.nx; ++i) {
    visit(i, 0);
    visit(i, grid.ny - 1);
  }
  for (int j = 0; j < grid.ny; ++j) {
    visit(0, j);
    visit(grid.nx - 1, j);
  }
  while (!edge.empty()) {
    const auto [i, j] = edge.front();
    edge.pop_front();
    visit(i + 1, j);
    visit(i - 1, j);
    visit(i, j + 1);
    visit(i, j - 1);
  }
  return beyond;
}

}  // namespace

double SurveyTerrain::HeightAt(const Vec2& place_m) const {
  const Vec2 cell = (place_m - grid.low_m) / grid.cell_m - Vec2(0.5, 0.5);
  const double gx = std::clamp(cell.x(), 0.0, grid.nx - 1.0);
  const double gy = std::clamp(cell.y(), 0.0, grid.ny - 1.0);
  const int i = std::min(static_cast<int>(gx), grid.nx - 2);
  const int j = std::min(static_cast<int>(gy), grid.ny - 2);
  const double u = gx - i, v = gy - j;
  const auto z = [&](int di, int dj) {
    return static_cast<double>(height_m[grid.At(i + di, j + dj)]);
  };
  return (1 - v) * ((1 - u) * z(0, 0) + u * z(1, 0)) + v * ((1 - u) * z(0, 1) + u * z(1, 1));
}

std::int64_t SurveyTerrain::CountOf(HeightSource kind) const {
  return std::count(source.begin(), source.end(), kind);
}

SurveyTerrain MakeTerrain(const std::vector<Vec3>& p_m, const std::vector<float>& above_m,
                          double cell_m) {
  SurveyTerrain terrain;
  terrain.grid = GridOver(p_m, cell_m);
  const CellGrid& grid = terrain.grid;
  terrain.height_m = MediansOfGround(grid, p_m, above_m);
  std::vector<bool> has_thing(grid.size(), false), has_foot(grid.size(), false);
  for (std::size_t k = 0; k < p_m.size(); ++k) {
    if (above_m[k] <= 0) continue;
    has_thing[grid.CellOf(p_m[k])] = true;
    if (above_m[k] < kWallFoot_m) has_foot[grid.CellOf(p_m[k])] = true;
  }
  const std::vector<bool> beside_wall = Widened(grid, has_foot, 1);
  std::vector<bool> surveyed(grid.size(), false);
  for (std::size_t c = 0; c < grid.size(); ++c) {
    surveyed[c] = has_thing[c] || IsKnown(terrain.height_m[c]);
  }
  const int reach = std::max(1, static_cast<int>(std::lround(kSurveyReach_m / grid.cell_m)));
  const std::vector<bool> beyond = Beyond(grid, Widened(grid, surveyed, reach));
  terrain.source.assign(grid.size(), HeightSource::kMeasured);
  bool any = false;
  for (std::size_t c = 0; c < grid.size(); ++c) {
    HeightSource& source = terrain.source[c];
    if (beside_wall[c] || (has_thing[c] && !IsKnown(terrain.height_m[c]))) {
      source = HeightSource::kUnderThing;
    } else if (!IsKnown(terrain.height_m[c])) {
      source = beyond[c] ? HeightSource::kBeyondSurvey : HeightSource::kFilled;
    }
    any = any || source == HeightSource::kMeasured;
  }
  for (std::size_t c = 0; any && c < grid.size(); ++c) {
    if (terrain.source[c] != HeightSource::kMeasured) {
      terrain.height_m[c] = std::numeric_limits<float>::quiet_NaN();
    }
  }
  if (any) FillGaps(grid, &terrain.height_m);
  return terrain;
}

}  // namespace tera
