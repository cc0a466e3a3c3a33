#include "render/ground/terrain_renderer.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/check.h"
#include "render/ground/ground_cover.h"
#include "render/ground/ground_detail.h"
#include "render/ground/soil_colour.h"

namespace tera {
namespace {

constexpr double kErrorPx = 0.3;  // largest height error of a coarser stride, in the image
constexpr double kErrorM = 0.02;

GlObject DetailTexture() {
  constexpr int kLevels = 10;  // down to one texel
  static_assert(GroundDetail::kSide == 1 << (kLevels - 1));
  static const GroundDetail detail = MakeGroundDetail();  // the same for all grounds
  GlObject texture = MakeTexture(GL_RGBA8, GroundDetail::kSide, GroundDetail::kSide,
                                 Filter::kMipmapped, Wrap::kRepeat, kLevels);
  glTextureSubImage2D(texture.id(), 0, 0, 0, GroundDetail::kSide, GroundDetail::kSide, GL_RGBA,
                      GL_UNSIGNED_BYTE, detail.rgba.data());
  glGenerateTextureMipmap(texture.id());
  return texture;
}

}  // namespace

TerrainRenderer::TerrainRenderer(const SceneModel& model, const Vec3& to_sun_W, Workers* workers)
    : soils_(model.soils),
      paint_(model.ground_paint),
      weather_(model.environment.weather),
      workers_(workers),
      detail_(DetailTexture()),
      to_sun_W_(to_sun_W) {}

void TerrainRenderer::Restart(const TerrainSurface& terrain) {
  grid_ = terrain;
  tiles_.assign(terrain.tile_count(), Tile{});
  pools_.clear();
  pools_.emplace_back(1);
  if (terrain.base_cells() > 1) pools_.emplace_back(terrain.base_cells());
  textures_ = GroundTextures(terrain, soils_, paint_, weather_, to_sun_W_);
  apron_ = Apron(Surroundings(terrain, soils_));
}

void TerrainRenderer::Update(const TerrainSurface& terrain) {
  TERA_CHECK(terrain.nx >= 2 && terrain.ny >= 2, terrain.nx, terrain.ny);
  if (grid_ != terrain || tiles_.empty()) Restart(terrain);
  std::vector<TileIndex> changed;
  bool border = false;
  for (int b = 0; b < terrain.tiles_y(); ++b) {
    for (int a = 0; a < terrain.tiles_x(); ++a) {
      const std::uint32_t version = terrain.tile_version(a, b);
      Tile& tile = tiles_[terrain.tile_index(a, b)];
      if (tile.version == version) continue;
      tile.version = version;
      changed.push_back({a, b});
      border = border || terrain.IsBorderTile(a, b);
    }
  }
  UploadTiles(terrain, changed);
  textures_.Update(terrain, changed, workers_);
  if (weather_.rain_mmph > 0) apron_tone_ = SoilTone(terrain.at(0, 0).cover.moisture / 255.0, 0);
  if (border) apron_.Update(terrain);
}

/// Worker threads compute vertices and errors; the calling thread uploads them.
void TerrainRenderer::UploadTiles(const TerrainSurface& terrain,
                                  const std::vector<TileIndex>& changed) {
  std::vector<std::optional<TileGrid>> grids(changed.size());
  workers_->ForRanges(changed.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const TileIndex& t = changed[k];
      grids[k].emplace(terrain, t.x, t.y);
      tiles_[terrain.tile_index(t.x, t.y)].Measure(*grids[k]);
    }
  });
  for (std::size_t k = 0; k < changed.size(); ++k) {
    Tile& tile = tiles_[terrain.tile_index(changed[k].x, changed[k].y)];
    const int pool = grids[k]->step_cells == 1 ? 0 : 1;
    if (tile.pool != pool) {
      tile.pool = pool;
      tile.place = pools_[pool].Add();
    }
    pools_[pool].Send(tile.place, *grids[k]);
    ++uploaded_tiles_;
  }
}

/// Sets the bounding box and the errors of coarser strides.
void TerrainRenderer::Tile::Measure(const TileGrid& grid) {
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& p : grid.vertices_W_m) box.extend(p);
  box_W_m = box.cast<double>();
  for (std::size_t s = 0; s < kTileStrides.size(); ++s) {
    const int stride = kTileStrides[s];
    const bool coarser = stride > grid.step_cells && stride % grid.step_cells == 0;
    error_m[s] = coarser                     ? grid.StrideError_m(stride)
                 : stride == grid.step_cells ? 0
                                             : std::numeric_limits<float>::infinity();
  }
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
  textures_.Bind(0, apron_program_);
  glBindTextureUnit(3, detail_.id());
  apron_program_.Set("u_ground_albedo", 0);
  apron_program_.Set("u_detail", 3);
  const Vec2 low_W_m = grid_.origin_W_m;
  const Vec2 high_W_m(grid_.x_m(grid_.nx - 1), grid_.y_m(grid_.ny - 1));
  apron_program_.Set("u_site_low_W", Eigen::Vector2f(low_W_m.cast<float>()));
  apron_program_.Set("u_site_high_W", Eigen::Vector2f(high_W_m.cast<float>()));
  const TerrainSurface::Cover undisturbed;
  apron_program_.Set("u_tone", static_cast<float>(std::sqrt(apron_tone_)));
  apron_program_.Set("u_snow", static_cast<float>(SnowShare(weather_, undisturbed, 1)));
  apron_program_.Set("u_snow_root", Eigen::Vector3f(kSnowAlbedo.cwiseSqrt().cast<float>()));
  apron_.Draw();
  triangles_drawn_ += apron_.triangles();
}

void TerrainRenderer::DrawTiles(const View& view) const {
  struct Visible {
    double distance_m;
    const Tile* tile;
  };
  std::vector<Visible> visible;
  for (const Tile& tile : tiles_) {
    if (!view.Sees(tile.box_W_m.min(), tile.box_W_m.max())) continue;
    visible.push_back({tile.box_W_m.exteriorDistance(view.eye_W_m), &tile});
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
  int bound = -1;
  for (const auto& [distance_m, tile] : visible) {
    if (tile->pool != bound) pools_[tile->pool].Bind();
    bound = tile->pool;
    triangles_drawn_ +=
        pools_[tile->pool].Draw(tile->place, tile->StrideFor(distance_m, view.fy_px));
  }
}

/// The largest stride whose error is not visible at this distance.
int TerrainRenderer::Tile::StrideFor(double distance_m, double fy_px) const {
  const double limit_m = std::min(kErrorM, kErrorPx * distance_m / fy_px);
  std::size_t s = kTileStrides.size() - 1;
  while (error_m[s] > limit_m) --s;
  return kTileStrides[s];
}

}  // namespace tera
