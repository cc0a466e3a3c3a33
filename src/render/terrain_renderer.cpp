#include "render/terrain_renderer.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "render/ground_detail.h"

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

GlObject DetailTexture() {
  constexpr int kLevels = 10;  // down to one texel
  static_assert(GroundDetail::kSide == 1 << (kLevels - 1));
  const GroundDetail detail = MakeGroundDetail();
  GlObject texture = MakeTexture(GL_RGBA8, GroundDetail::kSide, GroundDetail::kSide,
                                 Filter::kMipmapped, Wrap::kRepeat, kLevels);
  glTextureSubImage2D(texture.id(), 0, 0, 0, GroundDetail::kSide, GroundDetail::kSide, GL_RGBA,
                      GL_UNSIGNED_BYTE, detail.rgba.data());
  glGenerateTextureMipmap(texture.id());
  return texture;
}

}  // namespace

TerrainRenderer::TerrainRenderer(const SceneModel& model, const Vec3& to_sun_W)
    : soils_(model.soils), detail_(DetailTexture()), to_sun_W_(to_sun_W) {
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
  textures_ = GroundTextures(terrain, soils_, to_sun_W_);
  apron_ = Apron(Surroundings(terrain, soils_));
}

void TerrainRenderer::Update(const TerrainSurface& terrain) {
  TERA_CHECK(terrain.nx >= 2 && terrain.ny >= 2, terrain.nx, terrain.ny);
  const bool same_grid = nx_ == terrain.nx && ny_ == terrain.ny && cell_m_ == terrain.cell_m &&
                         origin_W_m_ == terrain.origin_W_m;
  if (!same_grid) Allocate(terrain);
  std::vector<TileIndex> changed;
  bool border = false;
  for (int ty = 0; ty < tiles_y_; ++ty) {
    for (int tx = 0; tx < tiles_x_; ++tx) {
      const std::size_t t = static_cast<std::size_t>(ty) * tiles_x_ + tx;
      Tile& tile = tiles_[t];
      if (tile.uploaded && tile.version == terrain.tile_version[t]) continue;
      tile.uploaded = true;
      tile.version = terrain.tile_version[t];
      UploadTile(terrain, tx, ty);
      changed.push_back({tx, ty});
      border = border || IsBorderTile(terrain, tx, ty);
      ++uploaded_tiles_;
    }
  }
  textures_.Update(terrain, changed);
  if (border) apron_.Update(terrain);
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

void TerrainRenderer::Draw(const View& view) const {
  if (tiles_.empty()) return;
  DrawTiles(view);
  DrawApron(view);
}

void TerrainRenderer::DrawApron(const View& view) const {
  apron_program_.Use();
  apron_program_.Set("u_clip_from_relative", view.ClipFromRelative());
  apron_program_.Set("u_eye_W", Eigen::Vector3f(view.eye_W_m.cast<float>()));
  apron_program_.Set("u_detail", 0);
  glBindTextureUnit(0, detail_.id());
  apron_.Draw();
  triangles_drawn_ += apron_.triangles();
}

void TerrainRenderer::DrawTiles(const View& view) const {
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
  ground_program_.Use();
  ground_program_.Set("u_clip_from_relative", view.ClipFromRelative());
  ground_program_.Set("u_eye_W", Eigen::Vector3f(view.eye_W_m.cast<float>()));
  textures_.Bind(0, ground_program_);
  glBindTextureUnit(3, detail_.id());
  ground_program_.Set("u_ground_albedo", 0);
  ground_program_.Set("u_ground_shape", 1);
  ground_program_.Set("u_detail", 3);
  glBindVertexArray(array_.id());
  for (const Visible& v : visible) {
    const Tile& tile = tiles_[v.tile];
    const double limit_m = std::min(kErrorM, kErrorPx * v.distance_m / view.fy_px);
    std::size_t s = kStrides.size() - 1;
    while (s > 0 && tile.error_m[s] > limit_m) --s;
    glDrawElementsBaseVertex(GL_TRIANGLES, ranges_[s].count, GL_UNSIGNED_SHORT,
                             reinterpret_cast<const void*>(ranges_[s].offset_bytes),
                             static_cast<GLint>(v.tile * kTileVertices));
    triangles_drawn_ += ranges_[s].count / 3;
  }
}

}  // namespace tera
