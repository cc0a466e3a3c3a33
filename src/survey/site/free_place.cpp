#include "survey/site/free_place.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tera {
namespace {

constexpr double kStep_m = 0.5;  ///< spacing of candidate places and of ground samples

Vec2 SizeOf(const CellGrid& grid) { return grid.cell_m * Vec2(grid.nx, grid.ny); }

bool IsClear(const SurveySite& site, const Vec2& place_m, double clearance_m) {
  const CellGrid& grid = site.terrain.grid;
  const Vec2 from_low = place_m - grid.low_m;
  const Vec2 to_high = SizeOf(grid) - from_low;
  if (std::min(from_low.minCoeff(), to_high.minCoeff()) < clearance_m) return false;
  return std::none_of(site.things.begin(), site.things.end(), [&](const SurveyThing& thing) {
    return thing.footprint.Holds(place_m, clearance_m);
  });
}

/// Height range of the ground around a place; nullopt if less than four fifths of it are measured.
std::optional<double> ReliefAround(const SurveySite& site, const Vec2& place_m, double radius_m) {
  const CellGrid& grid = site.terrain.grid;
  double lowest_m = std::numeric_limits<double>::infinity(), highest_m = -lowest_m;
  int samples = 0, measured = 0;
  for (double dy = -radius_m; dy <= radius_m; dy += kStep_m) {
    for (double dx = -radius_m; dx <= radius_m; dx += kStep_m) {
      if (std::hypot(dx, dy) > radius_m) continue;
      const Vec2 at = place_m + Vec2(dx, dy);
      const std::size_t cell = grid.At(grid.Column(at.x()), grid.Row(at.y()));
      ++samples;
      measured += site.terrain.source[cell] == HeightSource::kMeasured ? 1 : 0;
      lowest_m = std::min(lowest_m, static_cast<double>(site.terrain.height_m[cell]));
      highest_m = std::max(highest_m, static_cast<double>(site.terrain.height_m[cell]));
    }
  }
  constexpr int kOf = 5, kNeed = 4;
  if (measured * kOf < samples * kNeed) return std::nullopt;
  return highest_m - lowest_m;
}

template <typename Visit>
void ForPlaces(const CellGrid& grid, Visit visit) {
  const Vec2 size_m = SizeOf(grid);
  for (double y = 0.5 * kStep_m; y < size_m.y(); y += kStep_m) {
    for (double x = 0.5 * kStep_m; x < size_m.x(); x += kStep_m) visit(grid.low_m + Vec2(x, y));
  }
}

}  // namespace

std::optional<Vec2> FindFreePlace(const SurveySite& site, const PlaceNeed& need) {
  constexpr double kPerMetre = 0.01;  ///< relief that is equivalent to a distance of one metre from
                                      ///< the centre
  const Vec2 middle_m = site.terrain.grid.low_m + 0.5 * SizeOf(site.terrain.grid);
  std::optional<Vec2> best;
  double best_cost = std::numeric_limits<double>::infinity();
  ForPlaces(site.terrain.grid, [&](const Vec2& place_m) {
    if (!IsClear(site, place_m, need.clearance_m)) return;
    const auto relief_m = ReliefAround(site, place_m, need.radius_m);
    if (!relief_m || *relief_m > need.most_relief_m) return;
    const double cost = *relief_m + kPerMetre * (place_m - middle_m).norm();
    if (cost < best_cost) {
      best_cost = cost;
      best = place_m;
    }
  });
  return best;
}

Vec2 FindOverlook(const SurveySite& site) {
  const CellGrid& grid = site.terrain.grid;
  const Vec2 middle_m = grid.low_m + 0.5 * SizeOf(grid);
  Vec2 best = middle_m;
  ForPlaces(grid, [&](const Vec2& place_m) {
    const std::size_t cell = grid.At(grid.Column(place_m.x()), grid.Row(place_m.y()));
    if (site.terrain.source[cell] != HeightSource::kMeasured) return;
    if (!IsClear(site, place_m, 2 * kStep_m)) return;
    if ((place_m - middle_m).norm() > (best - middle_m).norm()) best = place_m;
  });
  return best;
}

}  // namespace tera
