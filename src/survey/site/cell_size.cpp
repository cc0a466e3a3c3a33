#include "survey/site/cell_size.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "core/error.h"

namespace tera {
namespace {

constexpr std::array<double, 7> kSizes_m = {0.05, 0.1, 0.2, 0.25, 0.5, 1.0, 2.0};
constexpr double kMostCells = 2.5e7;  ///< largest elevation raster that a scenario can load
constexpr double kGoodShare = 0.5, kLeastShare = 0.25;

/// Number of squares of this size that contain points.
std::size_t Occupied(const std::vector<Vec3>& p_m, double size_m) {
  std::vector<std::array<std::int64_t, 2>> squares;
  squares.reserve(p_m.size());
  for (const Vec3& p : p_m) {
    squares.push_back({static_cast<std::int64_t>(std::floor(p.x() / size_m)),
                       static_cast<std::int64_t>(std::floor(p.y() / size_m))});
  }
  std::sort(squares.begin(), squares.end());
  return static_cast<std::size_t>(std::unique(squares.begin(), squares.end()) - squares.begin());
}

double ShareWithPoints(const std::vector<Vec3>& p_m, double cell_m) {
  constexpr int kBlock = 8;
  return static_cast<double>(Occupied(p_m, cell_m)) /
         (kBlock * kBlock * static_cast<double>(Occupied(p_m, kBlock * cell_m)));
}

double CellsOver(const std::vector<Vec3>& p_m, double cell_m) {
  Vec2 low_m = p_m.front().head<2>(), high_m = low_m;
  for (const Vec3& p : p_m) {
    low_m = low_m.cwiseMin(p.head<2>());
    high_m = high_m.cwiseMax(p.head<2>());
  }
  const Vec2 cells = (high_m - low_m) / cell_m;
  return (cells.x() + 1) * (cells.y() + 1);
}

/// The finest size with sufficient coverage; 0 if there is none.
double FinestGood_m(const std::vector<Vec3>& p_m) {
  for (const double size_m : kSizes_m) {
    if (CellsOver(p_m, size_m) <= kMostCells && ShareWithPoints(p_m, size_m) >= kGoodShare) {
      return size_m;
    }
  }
  return 0;
}

}  // namespace

double CellSize(const std::filesystem::path& file, const std::vector<Vec3>& p_m,
                const std::optional<double>& wanted_m) {
  if (!wanted_m) {
    const double size_m = FinestGood_m(p_m);
    if (size_m == 0) {
      throw InputError(file.string(),
                       {FaultKind::kUnsupported,
                        fmt::format("its points are too sparse: fewer than half of the cells of {} "
                                    "m have one; need a denser survey, or give --cell",
                                    kSizes_m.back())});
    }
    return size_m;
  }
  const double cells = CellsOver(p_m, *wanted_m);
  if (cells > kMostCells) {
    throw InputError(
        file.string(),
        {FaultKind::kOutOfRange,
         fmt::format(
             "{:.3g} cells of {} m, need at most {:.2g}; use a larger --cell, or cut out the site",
             cells, *wanted_m, kMostCells)});
  }
  const double share = ShareWithPoints(p_m, *wanted_m);
  if (share < kLeastShare) {
    const double good_m = FinestGood_m(p_m);
    throw InputError(
        file.string(),
        {FaultKind::kOutOfRange,
         fmt::format("only {:.0f} % of the cells of {} m have points, need {:.0f} %; use {}",
                     100 * share, *wanted_m, 100 * kLeastShare,
                     good_m > 0 ? fmt::format("--cell {}", good_m) : "a denser survey")});
  }
  return *wanted_m;
}

}  // namespace tera
