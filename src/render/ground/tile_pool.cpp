#include "render/ground/tile_pool.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>

namespace tera {
namespace {

constexpr int kCellsOfTile = TerrainGrid::kTileCells;
constexpr float kSkirtM = 0.5f;
constexpr int kFirstCapacity = 16;  ///< tiles

}  // namespace

TileGrid::TileGrid(const TerrainSurface& terrain, int a, int b)
    : step_cells(terrain.step_cells(a, b)) {
  vertices_W_m.reserve(static_cast<std::size_t>(side()) * side());
  for (int j = 0; j < side(); ++j) {
    const int gj = std::min(b * kCellsOfTile + j * step_cells, terrain.ny - 1);
    for (int i = 0; i < side(); ++i) {
      const int gi = std::min(a * kCellsOfTile + i * step_cells, terrain.nx - 1);
      const Vec3 p_W_m(terrain.x_m(gi), terrain.y_m(gj), terrain.height_m(gi, gj));
      vertices_W_m.push_back(p_W_m.cast<float>());
    }
  }
}

float TileGrid::StrideError_m(int stride_cells) const {
  const int stride = stride_cells / step_cells, last = side() - 1;
  const auto height = [&](int i, int j) { return vertices_W_m[j * side() + i].z(); };
  float worst = 0;
  for (int j = 0; j < side(); ++j) {
    const int cj = std::min(j / stride, last / stride - 1) * stride;
    for (int i = 0; i < side(); ++i) {
      const int ci = std::min(i / stride, last / stride - 1) * stride;
      const float u = static_cast<float>(i - ci) / stride, v = static_cast<float>(j - cj) / stride;
      const float h00 = height(ci, cj), h11 = height(ci + stride, cj + stride);
      const float side_m = u >= v ? height(ci + stride, cj) : height(ci, cj + stride);
      const float coarse = u >= v ? h00 + u * (side_m - h00) + v * (h11 - side_m)
                                  : h00 + v * (side_m - h00) + u * (h11 - side_m);
      worst = std::max(worst, std::abs(height(i, j) - coarse));
    }
  }
  return worst;
}

TilePool::TilePool(int step_cells) : step_cells_(step_cells), array_(MakeVertexArray()) {
  std::vector<std::uint16_t> indices;
  for (std::size_t s = 0; s < kTileStrides.size(); ++s) {
    if (kTileStrides[s] % step_cells_ != 0) continue;
    const std::size_t first = indices.size();
    AppendIndices(kTileStrides[s] / step_cells_, &indices);
    ranges_[s] = {first * sizeof(std::uint16_t), static_cast<int>(indices.size() - first)};
  }
  indices_ = MakeBuffer(indices.size() * sizeof(std::uint16_t), indices.data());
  glEnableVertexArrayAttrib(array_.id(), 0);
  glVertexArrayAttribFormat(array_.id(), 0, 3, GL_FLOAT, GL_FALSE, 0);
  glVertexArrayAttribBinding(array_.id(), 0, 0);
  glVertexArrayElementBuffer(array_.id(), indices_.id());
}

/// Grid index of the k-th vertex of a border (0 south, 1 east, 2 north, 3 west), counted along +x
/// or +y.
int TilePool::BorderVertex(int border, int k) const {
  const int last = side() - 1;
  switch (border) {
    case 0:
      return GridVertex(k, 0);
    case 1:
      return GridVertex(last, k);
    case 2:
      return GridVertex(k, last);
    default:
      return GridVertex(0, k);
  }
}

void TilePool::AppendIndices(int stride, std::vector<std::uint16_t>* indices) const {
  const auto add = [&](int a, int b, int c) {
    for (int v : {a, b, c}) indices->push_back(static_cast<std::uint16_t>(v));
  };
  for (int j = 0; j + 1 < side(); j += stride) {
    for (int i = 0; i + 1 < side(); i += stride) {
      const int v00 = GridVertex(i, j), v10 = GridVertex(i + stride, j);
      const int v01 = GridVertex(i, j + stride), v11 = GridVertex(i + stride, j + stride);
      add(v00, v10, v11);
      add(v00, v11, v01);
    }
  }
  for (int border = 0; border < 4; ++border) {
    for (int k = 0; k + 1 < side(); k += stride) {
      const int a = BorderVertex(border, k), b = BorderVertex(border, k + stride);
      const int below_a = SkirtVertex(border, k), below_b = SkirtVertex(border, k + stride);
      add(a, below_a, below_b);
      add(a, below_b, b);
    }
  }
}

void TilePool::Grow() {
  const std::size_t tile_bytes = tile_vertices() * sizeof(Eigen::Vector3f);
  const int capacity = std::max(kFirstCapacity, 2 * capacity_);
  GlObject grown = MakeBuffer(capacity * tile_bytes, nullptr);
  if (count_ > 0) {
    glCopyNamedBufferSubData(vertices_.id(), grown.id(), 0, 0,
                             static_cast<GLsizeiptr>(count_ * tile_bytes));
  }
  vertices_ = std::move(grown);
  capacity_ = capacity;
  glVertexArrayVertexBuffer(array_.id(), 0, vertices_.id(), 0, sizeof(Eigen::Vector3f));
}

int TilePool::Add() {
  if (count_ == capacity_) Grow();
  return count_++;
}

void TilePool::Send(int place, const TileGrid& tile) {
  std::vector<Eigen::Vector3f> vertices = tile.vertices_W_m;
  for (int border = 0; border < 4; ++border) {
    for (int k = 0; k < side(); ++k) {
      vertices.push_back(vertices[BorderVertex(border, k)] - kSkirtM * Eigen::Vector3f::UnitZ());
    }
  }
  const std::size_t bytes = vertices.size() * sizeof(Eigen::Vector3f);
  glNamedBufferSubData(vertices_.id(), static_cast<GLintptr>(place * bytes),
                       static_cast<GLsizeiptr>(bytes), vertices.data());
}

void TilePool::Bind() const { glBindVertexArray(array_.id()); }

int TilePool::Draw(int place, int stride_cells) const {
  const auto s = std::find(kTileStrides.begin(), kTileStrides.end(), stride_cells);
  const IndexRange& range = ranges_[s - kTileStrides.begin()];
  glDrawElementsBaseVertex(GL_TRIANGLES, range.count, GL_UNSIGNED_SHORT,
                           reinterpret_cast<const void*>(range.offset_bytes),
                           static_cast<GLint>(place * tile_vertices()));
  return range.count / 3;
}

}  // namespace tera
