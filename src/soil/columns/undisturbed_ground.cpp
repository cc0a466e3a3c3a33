#include "soil/columns/undisturbed_ground.h"

#include <algorithm>
#include <cmath>

#include "soil/site/outline.h"

namespace tera {
namespace {

TerrainSurface::Cover CoverOf(const GroundProfile& profile) {
  const Stratum& top = profile.strata().front();
  return {.soil = top.soil,
          .moisture = static_cast<std::uint8_t>(std::lround(255.0f * top.moisture))};
}

/// True if a segment meets a box, by clipping the segment to one slab after the other.
bool Meets(const Vec2& from, const Vec2& to, const Vec2& low, const Vec2& high) {
  double enter = 0, leave = 1;
  for (int axis = 0; axis < 2; ++axis) {
    const double d = to[axis] - from[axis];
    if (d == 0) {
      if (from[axis] < low[axis] || from[axis] > high[axis]) return false;
      continue;
    }
    const double a = (low[axis] - from[axis]) / d, b = (high[axis] - from[axis]) / d;
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter <= leave;
}

}  // namespace

const Stratum& GroundProfile::Below(double depth_m) const {
  for (const Stratum& stratum : strata_) {
    if (depth_m < stratum.bottom_m) return stratum;
  }
  return strata_.back();
}

double GroundProfile::Mass_kgpm2(double from_m, double to_m) const {
  double sum_kgpm2 = 0, top_m = 0;
  for (const Stratum& stratum : strata_) {
    const double thickness_m = std::min(to_m, stratum.bottom_m) - std::max(from_m, top_m);
    if (thickness_m > 0) sum_kgpm2 += thickness_m * stratum.density_kgpm3;
    top_m = stratum.bottom_m;
  }
  return sum_kgpm2;
}

bool ProfileRegion::Contains(const Vec2& p_W_m) const { return Encloses(outline_W_m, p_W_m); }

bool ProfileRegion::CrossesBox(const Vec2& low, const Vec2& high) const {
  for (std::size_t k = 0, last = outline_W_m.size() - 1; k < outline_W_m.size(); last = k++) {
    if (Meets(outline_W_m[last], outline_W_m[k], low, high)) return true;
  }
  return false;
}

int ProfileMap::I(double x_m) const {
  return static_cast<int>(
      std::clamp(std::round((x_m - first_W_m.x()) / cell_m.x()), 0.0, nx - 1.0));
}

int ProfileMap::J(double y_m) const {
  return static_cast<int>(
      std::clamp(std::round((y_m - first_W_m.y()) / cell_m.y()), 0.0, ny - 1.0));
}

std::uint8_t ProfileMap::At(const Vec2& p_W_m) const {
  return profile[static_cast<std::size_t>(J(p_W_m.y())) * nx + I(p_W_m.x())];
}

bool ProfileMap::IsUniform(const Vec2& low_W_m, const Vec2& high_W_m) const {
  const std::uint8_t first = At(low_W_m);
  for (int j = J(low_W_m.y()); j <= J(high_W_m.y()); ++j) {
    const std::uint8_t* row = &profile[static_cast<std::size_t>(j) * nx];
    const bool same = std::all_of(row + I(low_W_m.x()), row + I(high_W_m.x()) + 1,
                                  [&](std::uint8_t p) { return p == first; });
    if (!same) return false;
  }
  return true;
}

double UndisturbedGround::HeightAt(int i, int j) const {
  const int a = std::min(i / base_cells, base_nx() - 2);
  const int b = std::min(j / base_cells, base_ny() - 2);
  const double* h = &base_height_m[static_cast<std::size_t>(b) * base_nx() + a];
  const double* above = h + base_nx();
  const int i0 = a * base_cells, j0 = b * base_cells;
  const double u = static_cast<double>(i - i0) / (BaseVertex(a + 1, grid.nx, base_cells) - i0);
  const double v = static_cast<double>(j - j0) / (BaseVertex(b + 1, grid.ny, base_cells) - j0);
  return u >= v ? h[0] + u * (h[1] - h[0]) + v * (above[1] - h[1])
                : h[0] + v * (above[0] - h[0]) + u * (above[1] - above[0]);
}

std::uint8_t UndisturbedGround::ProfileAt(const Vec2& p_W_m) const {
  for (auto region = regions.rbegin(); region != regions.rend(); ++region) {
    if (region->Contains(p_W_m)) return region->profile;
  }
  return map ? map->At(p_W_m) : 0;
}

bool UndisturbedGround::IsUniform(int a, int b) const {
  constexpr int kCells = TerrainGrid::kTileCells;
  const Vec2 low(grid.x_m(a * kCells), grid.y_m(b * kCells));
  const Vec2 high = low + Vec2::Constant(kCells * grid.cell_m);
  if (map && !map->IsUniform(low, high)) return false;
  return std::none_of(regions.begin(), regions.end(),
                      [&](const ProfileRegion& region) { return region.CrossesBox(low, high); });
}

TerrainSurface SurfaceOf(const UndisturbedGround& ground) {
  constexpr int kCells = TerrainGrid::kTileCells;
  const TerrainGrid& grid = ground.grid;
  std::vector<TerrainSurface::Cover> covers;
  for (int b = 0; b < grid.tiles_y(); ++b) {
    for (int a = 0; a < grid.tiles_x(); ++a) {
      const Vec2 corner(grid.x_m(a * kCells), grid.y_m(b * kCells));
      covers.push_back(CoverOf(ground.profiles[ground.ProfileAt(corner)]));
    }
  }
  const std::vector<double>& h = ground.base_height_m;
  TerrainSurface surface(grid, ground.base_cells, std::vector<float>(h.begin(), h.end()), covers);
  for (int b = 0; b < grid.tiles_y(); ++b) {
    for (int a = 0; a < grid.tiles_x(); ++a) {
      if (ground.IsUniform(a, b)) continue;
      for (int j = b * kCells; j <= std::min((b + 1) * kCells, grid.ny - 1); ++j) {
        for (int i = a * kCells; i <= std::min((a + 1) * kCells, grid.nx - 1); ++i) {
          const auto profile = ground.ProfileAt(Vec2(grid.x_m(i), grid.y_m(j)));
          surface.Set(i, j, {surface.height_m(i, j), CoverOf(ground.profiles[profile])});
        }
      }
    }
  }
  return surface;
}

}  // namespace tera
