#include "core/types/terrain_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/check.h"

namespace tera {
namespace {

/// The grid square that contains (x, y), and the position (u, v) in [0, 1] within it. A point
/// outside the site is clamped to the border.
struct Square {
  int i, j;
  double u, v;
};

Square Locate(const TerrainGrid& grid, double x_m, double y_m) {
  const double gx = std::clamp((x_m - grid.origin_W_m.x()) / grid.cell_m, 0.0, grid.nx - 1.0);
  const double gy = std::clamp((y_m - grid.origin_W_m.y()) / grid.cell_m, 0.0, grid.ny - 1.0);
  const int i = std::min(static_cast<int>(gx), grid.nx - 2);
  const int j = std::min(static_cast<int>(gy), grid.ny - 2);
  return {i, j, gx - i, gy - j};
}

/// Plane of the triangle that contains (u, v): the height at a corner and the slopes along x and y.
struct Plane {
  double height_m;
  Vec2 slope;
};

Plane PlaneUnder(const TerrainSurface& s, const Square& c) {
  const double h00 = s.height_m(c.i, c.j), h11 = s.height_m(c.i + 1, c.j + 1);
  if (c.u >= c.v) {
    const double h10 = s.height_m(c.i + 1, c.j);
    return {h00, Vec2(h10 - h00, h11 - h10)};
  }
  const double h01 = s.height_m(c.i, c.j + 1);
  return {h00, Vec2(h11 - h01, h01 - h00)};
}

}  // namespace

TerrainSurface::TerrainSurface(const TerrainGrid& grid)
    : TerrainSurface(
          grid, kTileCells,
          std::vector<float>(static_cast<std::size_t>(BaseVertexCount(grid.nx, kTileCells)) *
                             BaseVertexCount(grid.ny, kTileCells)),
          std::vector<Cover>(grid.tile_count())) {}

TerrainSurface::TerrainSurface(const TerrainGrid& grid, int base_cells,
                               std::vector<float> base_height_m, std::vector<Cover> tile_cover)
    : TerrainGrid(grid),
      base_cells_(base_cells),
      base_nx_(BaseVertexCount(grid.nx, base_cells)),
      base_height_m_(std::move(base_height_m)),
      tile_cover_(std::move(tile_cover)),
      version_(grid.tile_count(), 1),
      block_of_(grid.tile_count(), -1) {
  TERA_CHECK(nx >= 2 && ny >= 2, nx, ny);
  TERA_CHECK(base_cells_ > 0 && kTileCells % base_cells_ == 0, base_cells_);
  TERA_CHECK(base_height_m_.size() ==
                 static_cast<std::size_t>(base_nx_) * BaseVertexCount(ny, base_cells_),
             base_height_m_.size());
  TERA_CHECK(tile_cover_.size() == version_.size(), tile_cover_.size());
}

TerrainSurface::Slot TerrainSurface::SlotOf(int i, int j) const {
  const int a = std::min(i / kTileCells, tiles_x() - 1),
            b = std::min(j / kTileCells, tiles_y() - 1);
  return {tile_index(a, b), ((j - b * kTileCells) << kRowBits) | (i - a * kTileCells)};
}

float TerrainSurface::BaseHeight(int i, int j) const {
  const int a = std::min(i / base_cells_, base_nx_ - 2);
  const int b = std::min(j / base_cells_, BaseVertexCount(ny, base_cells_) - 2);
  const float* h = &base_height_m_[static_cast<std::size_t>(b) * base_nx_ + a];
  const int i0 = a * base_cells_, j0 = b * base_cells_;
  const auto width = static_cast<float>(BaseVertex(a + 1, nx, base_cells_) - i0);
  const auto depth = static_cast<float>(BaseVertex(b + 1, ny, base_cells_) - j0);
  const float u = static_cast<float>(i - i0) / width, v = static_cast<float>(j - j0) / depth;
  const float h00 = h[0], h11 = h[base_nx_ + 1];
  return u >= v ? h00 + u * (h[1] - h00) + v * (h11 - h[1])
                : h00 + v * (h[base_nx_] - h00) + u * (h11 - h[base_nx_]);
}

TerrainSurface::Vertex TerrainSurface::at(int i, int j) const {
  Vertex vertex = AsSet(i, j);
  if (Cover& cover = vertex.cover; cover.soil < wetness_.size()) {
    const Wetness& wetness = wetness_[cover.soil];
    cover.moisture = std::clamp(cover.moisture, wetness.least, wetness.most);
  }
  return vertex;
}

TerrainSurface::Vertex TerrainSurface::AsSet(int i, int j) const {
  const Slot slot = SlotOf(i, j);
  const std::int32_t block = block_of_[slot.tile];
  if (block >= 0) return blocks_[block][slot.local];
  return {BaseHeight(i, j), tile_cover_[slot.tile]};
}

float TerrainSurface::height_m(int i, int j) const {
  const Slot slot = SlotOf(i, j);
  const std::int32_t block = block_of_[slot.tile];
  return block >= 0 ? blocks_[block][slot.local].height_m : BaseHeight(i, j);
}

double TerrainSurface::HeightAt(double x_m, double y_m) const {
  const Square c = Locate(*this, x_m, y_m);
  const Plane plane = PlaneUnder(*this, c);
  return plane.height_m + plane.slope.x() * c.u + plane.slope.y() * c.v;
}

double TerrainSurface::Lowest_m() const {
  double lowest_m = std::numeric_limits<double>::infinity();
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) lowest_m = std::min<double>(lowest_m, height_m(i, j));
  }
  return lowest_m;
}

Vec3 TerrainSurface::NormalAt(double x_m, double y_m) const {
  const Vec2 slope = PlaneUnder(*this, Locate(*this, x_m, y_m)).slope;
  return Vec3(-slope.x(), -slope.y(), cell_m).normalized();
}

void TerrainSurface::Refine(int a, int b) {
  std::int32_t& block = block_of_[tile_index(a, b)];
  if (block >= 0) return;
  blocks_.emplace_back();
  const Cover cover = tile_cover_[tile_index(a, b)];
  const int i_end = a == tiles_x() - 1 ? nx : (a + 1) * kTileCells;
  const int j_end = b == tiles_y() - 1 ? ny : (b + 1) * kTileCells;
  for (int j = b * kTileCells; j < j_end; ++j) {
    for (int i = a * kTileCells; i < i_end; ++i) {
      blocks_.back()[SlotOf(i, j).local] = {BaseHeight(i, j), cover};
    }
  }
  block = static_cast<std::int32_t>(blocks_.size()) - 1;
  ++version_[tile_index(a, b)];
}

/// Visits each tile that has a square at vertex (i, j).
template <typename Visit>
void TerrainSurface::ForTilesAround(int i, int j, Visit visit) {
  const int a0 = std::max(0, (i - 1) / kTileCells), a1 = std::min(i / kTileCells, tiles_x() - 1);
  const int b0 = std::max(0, (j - 1) / kTileCells), b1 = std::min(j / kTileCells, tiles_y() - 1);
  for (int b = b0; b <= b1; ++b) {
    for (int a = a0; a <= a1; ++a) visit(a, b);
  }
}

void TerrainSurface::Set(int i, int j, const Vertex& vertex) {
  const Slot slot = SlotOf(i, j);
  if (block_of_[slot.tile] >= 0 && blocks_[block_of_[slot.tile]][slot.local] == vertex) return;
  // Every tile that shares this vertex is refined. The straight edges of a coarse tile could not
  // pass through the new height.
  ForTilesAround(i, j, [&](int a, int b) {
    Refine(a, b);
    ++version_[tile_index(a, b)];
  });
  blocks_[block_of_[slot.tile]][slot.local] = vertex;
}

void TerrainSurface::SetWetness(std::vector<Wetness> by_soil) {
  if (by_soil == wetness_) return;
  wetness_ = std::move(by_soil);
  for (std::uint32_t& version : version_) ++version;
}

void TerrainSurface::Follow(const TerrainSurface& other) {
  const auto is_of = [&](const TerrainSurface& ground) {
    return static_cast<const TerrainGrid&>(*this) == ground && base_cells_ == ground.base_cells_ &&
           base_height_m_ == ground.base_height_m_ && tile_cover_ == ground.tile_cover_;
  };
  if (!is_of(other)) {
    *this = other;
    return;
  }
  grains_ = other.grains_;
  wetness_ = other.wetness_;
  for (std::size_t tile = 0; tile < version_.size(); ++tile) {
    if (version_[tile] == other.version_[tile]) continue;
    version_[tile] = other.version_[tile];
    const std::int32_t from = other.block_of_[tile];
    std::int32_t& to = block_of_[tile];
    if (from < 0) {
      to = -1;
      continue;
    }
    if (to < 0) {
      blocks_.emplace_back();
      to = static_cast<std::int32_t>(blocks_.size()) - 1;
    }
    blocks_[to] = other.blocks_[from];
  }
}

}  // namespace tera
