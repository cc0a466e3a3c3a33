#include "render/ray_terrain.h"

#include <algorithm>

#include "core/check.h"

namespace tera {
namespace {

/// Share of its dry reflectance that a saturated soil keeps.
constexpr double kSaturatedReflectance = 0.5;

float* Vertices(RTCGeometry geometry) {
  return static_cast<float*>(rtcGetGeometryBufferData(geometry, RTC_BUFFER_TYPE_VERTEX, 0));
}

}  // namespace

void RayTerrain::Attach(Patch* patch) {
  patch->id = rtcAttachGeometry(scene_, patch->geometry.get());
  patch_of_.resize(std::max<std::size_t>(patch_of_.size(), patch->id + 1));
  patch_of_[patch->id] = patch;
}

/// Forgets the ground as it was, for a terrain of another size or place.
void RayTerrain::Restart(const TerrainSurface& terrain) {
  for (const Patch* patch : patch_of_) {
    if (patch != nullptr) rtcDetachGeometry(scene_, patch->id);
  }
  patch_of_.clear();
  land_ = Patch();
  tiles_.clear();
  nx_ = terrain.nx;
  ny_ = terrain.ny;
  cell_m_ = terrain.cell_m;
  origin_W_m_ = terrain.origin_W_m;
  if (nx_ < 2 || ny_ < 2) return;
  tiles_.resize(static_cast<std::size_t>(terrain.tiles_x()) * terrain.tiles_y());
  surroundings_ = Surroundings(terrain, soils_);
}

void RayTerrain::NewTile(Patch* tile, int squares_x, int squares_y) const {
  tile->geometry = EmbreeGeometry(rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_QUAD));
  const int row = squares_x + 1;
  const std::size_t squares = static_cast<std::size_t>(squares_x) * squares_y;
  auto* quads = static_cast<std::uint32_t*>(
      rtcSetNewGeometryBuffer(tile->geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4,
                              4 * sizeof(std::uint32_t), squares));
  for (int j = 0; j < squares_y; ++j) {
    for (int i = 0; i < squares_x; ++i) {
      // Embree splits a quad along its second and fourth corner: (i, j) and (i+1, j+1).
      const std::uint32_t v00 = static_cast<std::uint32_t>(j * row + i);
      const std::uint32_t corners[4] = {v00 + 1, v00 + 1 + row, v00 + row, v00};
      quads = std::copy_n(corners, 4, quads);
    }
  }
  rtcSetNewGeometryBuffer(tile->geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                          3 * sizeof(float), static_cast<std::size_t>(row) * (squares_y + 1));
  tile->reflectance.resize(squares);
}

void RayTerrain::RebuildTile(const TerrainSurface& terrain, int a, int b) {
  const int index = b * terrain.tiles_x() + a;
  Patch& tile = tiles_[index];
  const int i0 = a * TerrainSurface::kTileCells, j0 = b * TerrainSurface::kTileCells;
  const int squares_x = std::min(TerrainSurface::kTileCells, terrain.nx - 1 - i0);
  const int squares_y = std::min(TerrainSurface::kTileCells, terrain.ny - 1 - j0);
  const bool first = tile.geometry.get() == nullptr;
  if (first) NewTile(&tile, squares_x, squares_y);
  float* vertex = Vertices(tile.geometry.get());
  for (int j = 0; j <= squares_y; ++j) {
    for (int i = 0; i <= squares_x; ++i) {
      *vertex++ = static_cast<float>(terrain.origin_W_m.x() + terrain.cell_m * (i0 + i));
      *vertex++ = static_cast<float>(terrain.origin_W_m.y() + terrain.cell_m * (j0 + j));
      *vertex++ = terrain.height_m[terrain.index(i0 + i, j0 + j)];
    }
  }
  for (int j = 0; j < squares_y; ++j) {
    for (int i = 0; i < squares_x; ++i) {
      const std::size_t v = terrain.index(i0 + i, j0 + j);
      const double dry = soils_.at(terrain.soil[v]).albedo.mean();
      const double saturation = terrain.moisture[v] / 255.0;
      tile.reflectance[static_cast<std::size_t>(j) * squares_x + i] =
          static_cast<float>(dry * (1.0 - (1.0 - kSaturatedReflectance) * saturation));
    }
  }
  rtcUpdateGeometryBuffer(tile.geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0);
  rtcCommitGeometry(tile.geometry.get());
  if (first) Attach(&tile);
  tile.version = terrain.tile_version[index];
  ++tiles_rebuilt_;
}

void RayTerrain::RebuildLand(const TerrainSurface& terrain) {
  surroundings_.Update(terrain);
  const auto& vertices = surroundings_.vertices();
  const auto& indices = surroundings_.indices();
  const bool first = land_.geometry.get() == nullptr;
  if (first) {
    land_.geometry = EmbreeGeometry(rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE));
    rtcSetNewGeometryBuffer(land_.geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                            3 * sizeof(float), vertices.size());
    auto* corners = static_cast<std::uint32_t*>(
        rtcSetNewGeometryBuffer(land_.geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(std::uint32_t), indices.size() / 3));
    std::copy(indices.begin(), indices.end(), corners);
    for (std::size_t t = 0; t < indices.size(); t += 3) {
      land_.reflectance.push_back(vertices[indices[t]].albedo_root.cwiseAbs2().mean());
    }
  }
  float* at = Vertices(land_.geometry.get());
  for (const Surroundings::Vertex& v : vertices) at = std::copy_n(v.position_W_m.data(), 3, at);
  rtcUpdateGeometryBuffer(land_.geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0);
  rtcCommitGeometry(land_.geometry.get());
  if (first) Attach(&land_);
}

void RayTerrain::Update(const TerrainSurface& terrain) {
  if (terrain.nx != nx_ || terrain.ny != ny_ || terrain.cell_m != cell_m_ ||
      terrain.origin_W_m != origin_W_m_) {
    Restart(terrain);
  }
  if (nx_ < 2 || ny_ < 2) return;
  TERA_CHECK(terrain.tile_version.size() == tiles_.size(), terrain.tile_version.size());
  bool border = false;
  for (int b = 0; b < terrain.tiles_y(); ++b) {
    for (int a = 0; a < terrain.tiles_x(); ++a) {
      const int index = b * terrain.tiles_x() + a;
      const bool built = tiles_[index].geometry.get() != nullptr;
      if (built && tiles_[index].version == terrain.tile_version[index]) continue;
      RebuildTile(terrain, a, b);
      border = border || IsBorderTile(terrain, a, b);
    }
  }
  if (border) RebuildLand(terrain);
}

float RayTerrain::ReflectanceAt(unsigned geometry, unsigned primitive) const {
  return patch_of_[geometry]->reflectance[primitive];
}

}  // namespace tera
