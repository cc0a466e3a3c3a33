#include "render/rays/ray_terrain.h"

#include <algorithm>

#include "render/ground/ground_cover.h"
#include "render/meshes/grain_shape.h"
#include "render/meshes/near_infrared.h"

namespace tera {
namespace {

/// Reflectance of saturated soil relative to dry soil.
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

void RayTerrain::Detach(Patch* patch) {
  if (patch->id == RTC_INVALID_GEOMETRY_ID) return;
  rtcDetachGeometry(scene_, patch->id);
  patch_of_[patch->id] = nullptr;
  patch->id = RTC_INVALID_GEOMETRY_ID;
}

/// Removes all geometries, for a terrain of another size or position.
void RayTerrain::Restart(const TerrainSurface& terrain) {
  for (const Patch* patch : patch_of_) {
    if (patch != nullptr) rtcDetachGeometry(scene_, patch->id);
  }
  patch_of_.clear();
  land_ = Patch();
  grains_ = Patch();
  tiles_.clear();
  grid_ = terrain;
  if (grid_.nx < 2 || grid_.ny < 2) return;
  tiles_.resize(grid_.tile_count());
  surroundings_ = Surroundings(terrain, soils_);
}

void RayTerrain::NewTile(Patch* tile, int squares_x, int squares_y) {
  Detach(tile);  // replaces the undisturbed tile
  tile->geometry = EmbreeGeometry(rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_QUAD));
  const int row = squares_x + 1;
  const std::size_t squares = static_cast<std::size_t>(squares_x) * squares_y;
  auto* quads = static_cast<std::uint32_t*>(
      rtcSetNewGeometryBuffer(tile->geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4,
                              4 * sizeof(std::uint32_t), squares));
  for (int j = 0; j < squares_y; ++j) {
    for (int i = 0; i < squares_x; ++i) {
      // Embree splits a quad along the diagonal of its second and fourth corner: (i, j) and (i+1,
      // j+1).
      const std::uint32_t v00 = static_cast<std::uint32_t>(j * row + i);
      const std::uint32_t corners[4] = {v00 + 1, v00 + 1 + row, v00 + row, v00};
      quads = std::copy_n(corners, 4, quads);
    }
  }
  rtcSetNewGeometryBuffer(tile->geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                          3 * sizeof(float), static_cast<std::size_t>(row) * (squares_y + 1));
  tile->reflectance.resize(squares);
}

float RayTerrain::Reflectance(std::uint8_t soil, double saturation) const {
  const double dry = SoilNearInfrared(soils_.at(soil).albedo);
  return static_cast<float>(dry * (1.0 - (1.0 - kSaturatedReflectance) * saturation / 255.0));
}

/// Reflectance of the ground at a vertex, including weather.
float RayTerrain::ReflectanceAt(const TerrainSurface& terrain, int i, int j) const {
  const TerrainSurface::Cover cover = terrain.at(i, j).cover;
  const float bare = Reflectance(cover.soil, cover.moisture);
  if (weather_.snow_depth_m <= 0) return bare;
  const Vec3 normal_W = terrain.NormalAt(terrain.x_m(i), terrain.y_m(j));
  const auto snow = static_cast<float>(SnowShare(weather_, cover, normal_W.z()));
  return bare + snow * (static_cast<float>(kSnowReflectance) - bare);
}

void RayTerrain::RebuildTile(const TerrainSurface& terrain, int a, int b) {
  Patch& tile = tiles_[terrain.tile_index(a, b)];
  const int i0 = a * TerrainGrid::kTileCells, j0 = b * TerrainGrid::kTileCells;
  const int i1 = std::min(i0 + TerrainGrid::kTileCells, terrain.nx - 1);
  const int j1 = std::min(j0 + TerrainGrid::kTileCells, terrain.ny - 1);
  const int step = terrain.step_cells(a, b);
  const int squares_x = (i1 - i0 + step - 1) / step, squares_y = (j1 - j0 + step - 1) / step;
  const bool is_new = tile.step_cells != step;
  if (is_new) NewTile(&tile, squares_x, squares_y);
  tile.step_cells = step;
  float* vertex = Vertices(tile.geometry.get());
  for (int j = 0; j <= squares_y; ++j) {
    for (int i = 0; i <= squares_x; ++i) {
      const int vi = std::min(i0 + i * step, i1), vj = std::min(j0 + j * step, j1);
      const TerrainSurface::Vertex v = terrain.at(vi, vj);
      *vertex++ = static_cast<float>(terrain.x_m(vi));
      *vertex++ = static_cast<float>(terrain.y_m(vj));
      *vertex++ = v.height_m;
      if (i == squares_x || j == squares_y) continue;
      tile.reflectance[static_cast<std::size_t>(j) * squares_x + i] =
          ReflectanceAt(terrain, vi, vj);
    }
  }
  rtcUpdateGeometryBuffer(tile.geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0);
  rtcCommitGeometry(tile.geometry.get());
  if (is_new) Attach(&tile);
  tile.version = terrain.tile_version(a, b);
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
      land_.reflectance.push_back(vertices[indices[t]].near_infrared);
    }
  }
  float* at = Vertices(land_.geometry.get());
  for (const Surroundings::Vertex& v : vertices) at = std::copy_n(v.position_W_m.data(), 3, at);
  rtcUpdateGeometryBuffer(land_.geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0);
  rtcCommitGeometry(land_.geometry.get());
  if (first) Attach(&land_);
}

void RayTerrain::RebuildGrains(const TerrainSurface& terrain) {
  Detach(&grains_);
  if (terrain.grains().empty()) return;
  const GrainShape& shape = UnitGrain();
  const std::size_t count = terrain.grains().size();
  grains_.geometry = EmbreeGeometry(rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE));
  grains_.reflectance.clear();
  auto* vertex = static_cast<float*>(
      rtcSetNewGeometryBuffer(grains_.geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                              3 * sizeof(float), count * shape.corners.size()));
  auto* corner = static_cast<std::uint32_t*>(
      rtcSetNewGeometryBuffer(grains_.geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(std::uint32_t), count * shape.faces.size()));
  std::uint32_t first = 0;
  for (const TerrainSurface::Grain& grain : terrain.grains()) {
    const Eigen::Affine3f X_WG = GrainToWorld(grain);
    for (const Eigen::Vector3f& p : shape.corners) {
      const Eigen::Vector3f p_W = X_WG * p;
      vertex = std::copy_n(p_W.data(), 3, vertex);
    }
    for (const auto& face : shape.faces) {
      for (const std::uint8_t k : face) *corner++ = first + k;
    }
    first += static_cast<std::uint32_t>(shape.corners.size());
    grains_.reflectance.insert(grains_.reflectance.end(), shape.faces.size(),
                               Reflectance(grain.soil, grain.moisture));
  }
  rtcCommitGeometry(grains_.geometry.get());
  Attach(&grains_);
}

void RayTerrain::Update(const TerrainSurface& terrain) {
  if (grid_ != terrain) Restart(terrain);
  bool border = false;
  for (int b = 0; !tiles_.empty() && b < terrain.tiles_y(); ++b) {
    for (int a = 0; a < terrain.tiles_x(); ++a) {
      const Patch& tile = tiles_[terrain.tile_index(a, b)];
      if (tile.step_cells > 0 && tile.version == terrain.tile_version(a, b)) continue;
      RebuildTile(terrain, a, b);
      border = border || terrain.IsBorderTile(a, b);
    }
  }
  if (border) RebuildLand(terrain);
  RebuildGrains(terrain);
}

float RayTerrain::ReflectanceAt(unsigned geometry, unsigned primitive) const {
  return patch_of_[geometry]->reflectance[primitive];
}

}  // namespace tera
