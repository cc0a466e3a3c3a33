#include "survey/site/ground_filter.h"

#include <pcl/segmentation/progressive_morphological_filter.h>

#include <cmath>
#include <deque>
#include <limits>
#include <pcl/filters/impl/morphological_filter.hpp>
#include <pcl/segmentation/impl/progressive_morphological_filter.hpp>

#include "survey/points/pcl_cloud.h"
#include "survey/site/cell_grid.h"
#include "survey/site/fill_gaps.h"

namespace tera {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

std::vector<float> LowestOfSquares(const CellGrid& grid, const std::vector<Vec3>& p_m) {
  std::vector<float> lowest_m(grid.size(), kUnknown);
  for (const Vec3& p : p_m) {
    float& z = lowest_m[grid.CellOf(p)];
    if (!IsKnown(z) || p.z() < z) z = static_cast<float>(p.z());
  }
  return lowest_m;
}

/// Squares that pass the morphological filter. Coordinates are in units of squares, because PCL
/// multiplies its windows and its slope threshold by the cell size a second time.
std::vector<bool> Opened(const CellGrid& grid, const std::vector<float>& lowest_m,
                         const GroundRule& rule) {
  auto cloud = std::make_shared<PclCloud>();
  std::vector<std::size_t> squares;
  for (int j = 0; j < grid.ny; ++j) {
    for (int i = 0; i < grid.nx; ++i) {
      const float z = lowest_m[grid.At(i, j)];
      if (!IsKnown(z)) continue;
      cloud->push_back(pcl::PointXYZ(static_cast<float>(i), static_cast<float>(j), z));
      squares.push_back(grid.At(i, j));
    }
  }
  constexpr float kGrowth = 1.5F;
  const double slope_m = std::tan(rule.opening_slope_rad) * grid.cell_m;
  pcl::ProgressiveMorphologicalFilter<pcl::PointXYZ> filter;
  filter.setInputCloud(cloud);
  filter.setCellSize(1.0F);
  filter.setBase(kGrowth);
  filter.setMaxWindowSize(static_cast<int>(std::ceil(rule.largest_thing_m / grid.cell_m)) + 2);
  filter.setSlope(static_cast<float>(slope_m));
  filter.setInitialDistance(static_cast<float>(rule.clearance_m + slope_m));
  filter.setMaxDistance(std::numeric_limits<float>::max());
  pcl::Indices ground;
  filter.extract(ground);
  std::vector<bool> is_ground(grid.size(), false);
  for (const int k : ground) is_ground[squares[static_cast<std::size_t>(k)]] = true;
  return is_ground;
}

/// Lets the ground grow back up slopes.
void GrowUpSlopes(const CellGrid& grid, const std::vector<float>& lowest_m, const GroundRule& rule,
                  std::vector<bool>* is_ground) {
  constexpr int kReach = 2;  // across one square without points
  std::deque<std::array<int, 2>> edge;
  for (int j = 0; j < grid.ny; ++j) {
    for (int i = 0; i < grid.nx; ++i) {
      if ((*is_ground)[grid.At(i, j)]) edge.push_back({i, j});
    }
  }
  const double slope = std::tan(rule.steepest_rad);
  while (!edge.empty()) {
    const auto [i, j] = edge.front();
    edge.pop_front();
    for (int dj = -kReach; dj <= kReach; ++dj) {
      for (int di = -kReach; di <= kReach; ++di) {
        if (!grid.Has(i + di, j + dj)) continue;
        const std::size_t other = grid.At(i + di, j + dj);
        if ((*is_ground)[other] || !IsKnown(lowest_m[other])) continue;
        // A square is skipped only if it has no points.
        if ((std::abs(di) > 1 || std::abs(dj) > 1) &&
            IsKnown(lowest_m[grid.At(i + di / 2, j + dj / 2)])) {
          continue;
        }
        const double rise_m = lowest_m[other] - lowest_m[grid.At(i, j)];
        if (rise_m > rule.clearance_m + slope * grid.cell_m * std::hypot(di, dj)) continue;
        (*is_ground)[other] = true;
        edge.push_back({i + di, j + dj});
      }
    }
  }
}

/// Highest value of each square and its eight neighbours.
std::vector<float> HighestAround(const CellGrid& grid, const std::vector<float>& height_m) {
  std::vector<float> highest_m(grid.size());
  for (int j = 0; j < grid.ny; ++j) {
    for (int i = 0; i < grid.nx; ++i) {
      float highest = height_m[grid.At(i, j)];
      for (int dj = -1; dj <= 1; ++dj) {
        for (int di = -1; di <= 1; ++di) {
          if (grid.Has(i + di, j + dj)) {
            highest = std::max(highest, height_m[grid.At(i + di, j + dj)]);
          }
        }
      }
      highest_m[grid.At(i, j)] = highest;
    }
  }
  return highest_m;
}

}  // namespace

std::vector<float> HeightsAboveGround(const std::vector<Vec3>& p_m, const GroundRule& rule) {
  const CellGrid grid = GridOver(p_m, rule.square_m);
  std::vector<float> ground_m = LowestOfSquares(grid, p_m);
  std::vector<bool> is_ground = Opened(grid, ground_m, rule);
  GrowUpSlopes(grid, ground_m, rule, &is_ground);
  bool any = false;
  for (std::size_t k = 0; k < grid.size(); ++k) {
    any = any || is_ground[k];
    if (!is_ground[k]) ground_m[k] = kUnknown;
  }
  if (!any) return std::vector<float>(p_m.size(), 1.0F);
  FillGaps(grid, &ground_m);
  const std::vector<float> highest_m = HighestAround(grid, ground_m);
  std::vector<float> above_m;
  above_m.reserve(p_m.size());
  for (const Vec3& p : p_m) {
    above_m.push_back(static_cast<float>(p.z() - highest_m[grid.CellOf(p)] - rule.least_height_m));
  }
  return above_m;
}

}  // namespace tera
