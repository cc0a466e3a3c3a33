#include "core/terrain_surface.h"

#include <algorithm>
#include <cmath>

namespace tera {
namespace {

/// The square that holds (x, y), clamped to the site, and the place within it.
struct Cell {
  int i, j;
  double u, v;
};

Cell Locate(const TerrainSurface& s, double x_m, double y_m) {
  const double gx = std::clamp((x_m - s.origin_W_m.x()) / s.cell_m, 0.0, s.nx - 1.0);
  const double gy = std::clamp((y_m - s.origin_W_m.y()) / s.cell_m, 0.0, s.ny - 1.0);
  const int i = std::min(static_cast<int>(gx), s.nx - 2);
  const int j = std::min(static_cast<int>(gy), s.ny - 2);
  return {i, j, gx - i, gy - j};
}

/// Height differences along x and y over the triangle that holds (u, v).
Vec2 Slopes(const TerrainSurface& s, const Cell& c) {
  const double h00 = s.height_m[s.index(c.i, c.j)], h10 = s.height_m[s.index(c.i + 1, c.j)];
  const double h01 = s.height_m[s.index(c.i, c.j + 1)], h11 = s.height_m[s.index(c.i + 1, c.j + 1)];
  return c.u >= c.v ? Vec2(h10 - h00, h11 - h10) : Vec2(h11 - h01, h01 - h00);
}

}  // namespace

double TerrainSurface::HeightAt(double x_m, double y_m) const {
  const Cell c = Locate(*this, x_m, y_m);
  const Vec2 slope = Slopes(*this, c);
  return height_m[index(c.i, c.j)] + slope.x() * c.u + slope.y() * c.v;
}

Vec3 TerrainSurface::NormalAt(double x_m, double y_m) const {
  const Vec2 slope = Slopes(*this, Locate(*this, x_m, y_m));
  return Vec3(-slope.x(), -slope.y(), cell_m).normalized();
}

}  // namespace tera
