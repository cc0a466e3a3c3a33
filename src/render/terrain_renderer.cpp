#include "render/terrain_renderer.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>

#include "core/check.h"

namespace tera {
namespace {

constexpr int kCells = TerrainSurface::kTileCells;
constexpr int kSide = kCells + 1;                 // vertices along a tile's side
constexpr int kGrid = kSide * kSide;              // vertices of a tile's surface
constexpr int kTileVertices = kGrid + 4 * kSide;  // and of its skirt
constexpr double kErrorPx = 0.3;                  // height error of a coarser stride, as seen
constexpr double kErrorM = 0.02;
constexpr float kSkirtM = 0.5f;

int GridVertex(int i, int j) { return j * kSide + i; }

/// k-th vertex of border b (south, east, north, west) in the grid, counted along +x or +y.
int BorderVertex(int border, int k) {
  switch (border) {
    case 0:
      return GridVertex(k, 0);
    case 1:
      return GridVertex(kCells, k);
    case 2:
      return GridVertex(k, kCells);
    default:
      return GridVertex(0, k);
  }
}

int SkirtVertex(int border, int k) { return kGrid + border * kSide + k; }

void AppendGridIndices(int stride, std::vector<std::uint16_t>* indices) {
  const auto add = [&](int a, int b, int c) {
    for (int v : {a, b, c}) indices->push_back(static_cast<std::uint16_t>(v));
  };
  for (int j = 0; j < kCells; j += stride) {
    for (int i = 0; i < kCells; i += stride) {
      const int v00 = GridVertex(i, j), v10 = GridVertex(i + stride, j);
      const int v01 = GridVertex(i, j + stride), v11 = GridVertex(i + stride, j + stride);
      add(v00, v10, v11);
      add(v00, v11, v01);
    }
  }
  for (int border = 0; border < 4; ++border) {
    for (int k = 0; k < kCells; k += stride) {
      const int a = BorderVertex(border, k), b = BorderVertex(border, k + stride);
      const int below_a = SkirtVertex(border, k), below_b = SkirtVertex(border, k + stride);
      add(a, below_a, below_b);
      add(a, below_b, b);
    }
  }
}

/// Greatest difference between the tile's own surface and its surface with a larger stride, at
/// the vertices.
float StrideError(const std::vector<float>& heights, int stride) {
  float worst = 0;
  for (int j = 0; j < kSide; ++j) {
    const int cj = std::min(j / stride, kCells / stride - 1) * stride;
    for (int i = 0; i < kSide; ++i) {
      const int ci = std::min(i / stride, kCells / stride - 1) * stride;
      const float u = static_cast<float>(i - ci) / stride, v = static_cast<float>(j - cj) / stride;
      const float h00 = heights[GridVertex(ci, cj)];
      const float h11 = heights[GridVertex(ci + stride, cj + stride)];
      const float side =
          u >= v ? heights[GridVertex(ci + stride, cj)] : heights[GridVertex(ci, cj + stride)];
      const float coarse = u >= v ? h00 + u * (side - h00) + v * (h11 - side)
                                  : h00 + v * (side - h00) + u * (h11 - side);
      worst = std::max(worst, std::abs(heights[GridVertex(i, j)] - coarse));
    }
  }
  return worst;
}

std::uint16_t Unorm16(float value) {
  return static_cast<std::uint16_t>(std::lround(std::clamp(value, 0.0f, 1.0f) * 65535.0f));
}

}  // namespace

TerrainRenderer::TerrainRenderer(const SceneModel& model) : soils_(model.soils) {
  std::vector<std::uint16_t> indices;
  for (std::size_t s = 0; s < kStrides.size(); ++s) {
    const std::size_t first = indices.size();
    AppendGridIndices(kStrides[s], &indices);
    ranges_[s] = {first * sizeof(std::uint16_t), static_cast<int>(indices.size() - first)};
  }
  indices_ = MakeBuffer(indices.size() * sizeof(std::uint16_t), indices.data());
}

void TerrainRenderer::Allocate(const TerrainSurface& terrain) {
  nx_ = terrain.nx;
  ny_ = terrain.ny;
  tiles_x_ = terrain.tiles_x();
  tiles_y_ = terrain.tiles_y();
  cell_m_ = terrain.cell_m;
  origin_W_m_ = terrain.origin_W_m;
  tiles_.assign(static_cast<std::size_t>(tiles_x_) * tiles_y_, Tile{});
  vertices_ = MakeBuffer(tiles_.size() * kTileVertices * sizeof(Eigen::Vector3f), nullptr);
  array_ = MakeVertexArray();
  glEnableVertexArrayAttrib(array_.id(), 0);
  glVertexArrayAttribFormat(array_.id(), 0, 3, GL_FLOAT, GL_FALSE, 0);
  glVertexArrayAttribBinding(array_.id(), 0, 0);
  glVertexArrayVertexBuffer(array_.id(), 0, vertices_.id(), 0, sizeof(Eigen::Vector3f));
  glVertexArrayElementBuffer(array_.id(), indices_.id());
  albedo_ = MakeTexture(GL_RGBA8, nx_, ny_, Filter::kLinear, Wrap::kClamp);
  shape_ = MakeTexture(GL_RGBA16, nx_, ny_, Filter::kLinear, Wrap::kClamp);
}

void TerrainRenderer::Update(const TerrainSurface& terrain) {
  TERA_CHECK(terrain.nx >= 2 && terrain.ny >= 2, terrain.nx, terrain.ny);
  const bool same_grid = nx_ == terrain.nx && ny_ == terrain.ny && cell_m_ == terrain.cell_m &&
                         origin_W_m_ == terrain.origin_W_m;
  if (!same_grid) Allocate(terrain);
  for (int ty = 0; ty < tiles_y_; ++ty) {
    for (int tx = 0; tx < tiles_x_; ++tx) {
      const std::size_t t = static_cast<std::size_t>(ty) * tiles_x_ + tx;
      Tile& tile = tiles_[t];
      if (tile.uploaded && tile.version == terrain.tile_version[t]) continue;
      tile.uploaded = true;
      tile.version = terrain.tile_version[t];
      UploadTile(terrain, tx, ty);
      UploadMaterial(terrain, tx, ty);
      ++uploaded_tiles_;
    }
  }
}

void TerrainRenderer::UploadTile(const TerrainSurface& terrain, int tile_x, int tile_y) {
  Tile& tile = tiles_[static_cast<std::size_t>(tile_y) * tiles_x_ + tile_x];
  std::vector<Eigen::Vector3f> vertices(kTileVertices);
  std::vector<float> heights(kGrid);
  Eigen::AlignedBox3d box;
  for (int j = 0; j < kSide; ++j) {
    for (int i = 0; i < kSide; ++i) {
      // Squares beyond the last vertex of the site shrink to nothing.
      const int gi = std::min(tile_x * kCells + i, nx_ - 1);
      const int gj = std::min(tile_y * kCells + j, ny_ - 1);
      const float h = terrain.height_m[terrain.index(gi, gj)];
      heights[GridVertex(i, j)] = h;
      const Vec3 p_W_m(origin_W_m_.x() + gi * cell_m_, origin_W_m_.y() + gj * cell_m_, h);
      vertices[GridVertex(i, j)] = p_W_m.cast<float>();
      box.extend(p_W_m);
    }
  }
  for (int border = 0; border < 4; ++border) {
    for (int k = 0; k < kSide; ++k) {
      Eigen::Vector3f p = vertices[BorderVertex(border, k)];
      p.z() -= kSkirtM;
      vertices[SkirtVertex(border, k)] = p;
    }
  }
  for (std::size_t s = 1; s < kStrides.size(); ++s) {
    tile.error_m[s] = StrideError(heights, kStrides[s]);
  }
  tile.box_min_W_m = box.min();
  tile.box_max_W_m = box.max();
  const std::size_t first = static_cast<std::size_t>(&tile - tiles_.data()) * kTileVertices;
  glNamedBufferSubData(vertices_.id(), static_cast<GLintptr>(first * sizeof(Eigen::Vector3f)),
                       static_cast<GLsizeiptr>(kTileVertices * sizeof(Eigen::Vector3f)),
                       vertices.data());
}

void TerrainRenderer::UploadMaterial(const TerrainSurface& terrain, int tile_x, int tile_y) {
  const int i0 = tile_x * kCells, j0 = tile_y * kCells;
  const int width = std::min(kSide, nx_ - i0), height = std::min(kSide, ny_ - j0);
  std::vector<std::uint8_t> albedo;
  std::vector<std::uint16_t> shape;
  for (int j = j0; j < j0 + height; ++j) {
    for (int i = i0; i < i0 + width; ++i) {
      const std::size_t v = terrain.index(i, j);
      const Vec3 a = soils_.empty()
                         ? SoilAppearance{}.albedo
                         : soils_[std::min<std::size_t>(terrain.soil[v], soils_.size() - 1)].albedo;
      for (int k = 0; k < 3; ++k) {
        albedo.push_back(static_cast<std::uint8_t>(std::lround(std::sqrt(a[k]) * 255)));
      }
      albedo.push_back(255);
      const int il = std::max(i - 1, 0), ir = std::min(i + 1, nx_ - 1);
      const int jl = std::max(j - 1, 0), jr = std::min(j + 1, ny_ - 1);
      const float slope_x =
          (terrain.height_m[terrain.index(ir, j)] - terrain.height_m[terrain.index(il, j)]) /
          static_cast<float>((ir - il) * cell_m_);
      const float slope_y =
          (terrain.height_m[terrain.index(i, jr)] - terrain.height_m[terrain.index(i, jl)]) /
          static_cast<float>((jr - jl) * cell_m_);
      const Eigen::Vector3f n = Eigen::Vector3f(-slope_x, -slope_y, 1).normalized();
      shape.push_back(Unorm16(n.x() * 0.5f + 0.5f));
      shape.push_back(Unorm16(n.y() * 0.5f + 0.5f));
      shape.push_back(Unorm16(terrain.looseness[v] / 255.0f));
      shape.push_back(Unorm16(terrain.rut[v] / 255.0f));
    }
  }
  glTextureSubImage2D(albedo_.id(), 0, i0, j0, width, height, GL_RGBA, GL_UNSIGNED_BYTE,
                      albedo.data());
  glTextureSubImage2D(shape_.id(), 0, i0, j0, width, height, GL_RGBA, GL_UNSIGNED_SHORT,
                      shape.data());
}

void TerrainRenderer::Draw(const View& view, const Program& program) const {
  struct Visible {
    double distance_m;
    std::size_t tile;
  };
  std::vector<Visible> visible;
  for (std::size_t t = 0; t < tiles_.size(); ++t) {
    if (!view.Sees(tiles_[t].box_min_W_m, tiles_[t].box_max_W_m)) continue;
    const Eigen::AlignedBox3d box(tiles_[t].box_min_W_m, tiles_[t].box_max_W_m);
    visible.push_back({box.exteriorDistance(view.eye_W_m), t});
  }
  std::stable_sort(visible.begin(), visible.end(),
                   [](const Visible& a, const Visible& b) { return a.distance_m < b.distance_m; });
  glBindTextureUnit(0, albedo_.id());
  glBindTextureUnit(1, shape_.id());
  const Vec2 size_m = cell_m_ * Vec2(nx_, ny_);
  const Vec2 first_m = origin_W_m_ - Vec2::Constant(0.5 * cell_m_);  // edge of texel 0
  program.Set("u_texture_scale", Eigen::Vector2f(size_m.cwiseInverse().cast<float>()));
  program.Set("u_texture_origin", Eigen::Vector2f(first_m.cast<float>()));
  glBindVertexArray(array_.id());
  for (const Visible& v : visible) {
    const Tile& tile = tiles_[v.tile];
    const double limit_m = std::min(kErrorM, kErrorPx * v.distance_m / view.fy_px);
    std::size_t s = kStrides.size() - 1;
    while (s > 0 && tile.error_m[s] > limit_m) --s;
    glDrawElementsBaseVertex(GL_TRIANGLES, ranges_[s].count, GL_UNSIGNED_SHORT,
                             reinterpret_cast<const void*>(ranges_[s].offset_bytes),
                             static_cast<GLint>(v.tile * kTileVertices));
  }
}

}  // namespace tera
