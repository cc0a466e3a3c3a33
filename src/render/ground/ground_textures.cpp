#include "render/ground/ground_textures.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "render/ground/ground_cover.h"
#include "render/ground/hollows.h"
#include "render/ground/soil_colour.h"

namespace tera {
namespace {

constexpr int kCells = TerrainGrid::kTileCells;
constexpr double kRutDarker = 0.22;
constexpr double kTypicalGrain_m = 0.01;
constexpr float kUndisturbedDetail = 0.45f;  // strength of the detail relief relative to loose soil
constexpr int kTexelsOfAWindow = 4096;       // fixed cost of a transfer, in texels
constexpr double kSnowSmooths = 0.8;         // fraction of the relief that full snow cover removes

std::uint8_t Snorm8(double value) {
  return static_cast<std::uint8_t>(
      static_cast<std::int8_t>(std::lround(std::clamp(value, -1.0, 1.0) * 127.0)));
}

}  // namespace

GroundTextures::Pyramid::Pyramid(int width, int height, bool holds_signed)
    : is_signed(holds_signed) {
  for (int w = width, h = height;; w = std::max(w / 2, 1), h = std::max(h / 2, 1)) {
    levels.push_back({w, h, std::vector<std::uint8_t>(static_cast<std::size_t>(w) * h * 4)});
    if (w == 1 && h == 1) break;
  }
  texture = MakeTexture(is_signed ? GL_RGBA8_SNORM : GL_RGBA8, width, height, Filter::kMipmapped,
                        Wrap::kClamp, static_cast<int>(levels.size()));
}

void GroundTextures::Pyramid::Shrink(int level, const TexelWindow& window, Workers* workers) {
  constexpr int kLeastTexels = 2048;
  const auto rows = static_cast<std::size_t>(window.j1 - window.j0);
  const auto least = static_cast<std::size_t>(kLeastTexels / (window.i1 - window.i0) + 1);
  workers->ForRanges(rows, least, [&](std::size_t begin, std::size_t end) {
    ShrinkRows(level, {window.i0, window.j0 + static_cast<int>(begin), window.i1,
                       window.j0 + static_cast<int>(end)});
  });
}

void GroundTextures::Pyramid::ShrinkRows(int level, const TexelWindow& window) {
  const Level& fine = levels[level - 1];
  Level& coarse = levels[level];
  for (int j = window.j0; j < window.j1; ++j) {
    for (int i = window.i0; i < window.i1; ++i) {
      const int a0 = std::min(2 * i, fine.width - 1), a1 = std::min(2 * i + 1, fine.width - 1);
      const int b0 = std::min(2 * j, fine.height - 1), b1 = std::min(2 * j + 1, fine.height - 1);
      for (int k = 0; k < 4; ++k) {
        int sum = 0;
        for (const int b : {b0, b1}) {
          for (const int a : {a0, a1}) {
            const std::uint8_t t =
                fine.texels[(static_cast<std::size_t>(b) * fine.width + a) * 4 + k];
            sum += is_signed ? static_cast<std::int8_t>(t) : t;
          }
        }
        coarse.texels[(static_cast<std::size_t>(j) * coarse.width + i) * 4 + k] =
            static_cast<std::uint8_t>((sum + 2) >> 2);  // rounds to nearest, also below 0
      }
    }
  }
}

void GroundTextures::Pyramid::Upload(int level, const TexelWindow& w) const {
  const Level& l = levels[level];
  glPixelStorei(GL_UNPACK_ROW_LENGTH, l.width);
  glTextureSubImage2D(texture.id(), level, w.i0, w.j0, w.i1 - w.i0, w.j1 - w.j0, GL_RGBA,
                      is_signed ? GL_BYTE : GL_UNSIGNED_BYTE,
                      &l.texels[(static_cast<std::size_t>(w.j0) * l.width + w.i0) * 4]);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
}

void GroundTextures::Pyramid::Send(TexelWindow w, Workers* workers) {
  Upload(0, w);
  for (int level = 1; level < static_cast<int>(levels.size()); ++level) {
    const Level& l = levels[level];
    w.i0 = std::min(w.i0 / 2, l.width - 1);
    w.j0 = std::min(w.j0 / 2, l.height - 1);
    w.i1 = std::clamp((w.i1 + 1) / 2, w.i0 + 1, l.width);
    w.j1 = std::clamp((w.j1 + 1) / 2, w.j0 + 1, l.height);
    Shrink(level, w, workers);
    Upload(level, w);
  }
}

GroundTextures::GroundTextures(const TerrainSurface& terrain,
                               const std::vector<SoilAppearance>& soils,
                               std::shared_ptr<const GroundPaint> paint, const Weather& weather,
                               const Vec3& to_sun_W)
    : soils_(soils),
      paint_(std::move(paint)),
      weather_(weather),
      to_sun_W_(to_sun_W),
      origin_W_m_(terrain.origin_W_m),
      heights_(terrain),
      cover_(heights_.index(0, heights_.height())),
      sky_view_(heights_.texel_m()),
      shadow_(to_sun_W),
      albedo_(heights_.width(), heights_.height(), false),
      shape_(heights_.width(), heights_.height(), true) {
  if (soils_.empty()) soils_.push_back(SoilAppearance{});
  shadow_texture_ =
      MakeTexture(GL_R32F, heights_.width(), heights_.height(), Filter::kLinear, Wrap::kClamp);
  if (weather_.puddle_depth_m <= 0) return;
  HeightTexels all(terrain);
  all.Read(terrain, {0, 0, all.width(), all.height()});
  std::vector<float> height_m;
  for (std::size_t k = 0; k < all.index(0, all.height()); ++k) height_m.push_back(all.at(k));
  water_m_ = WaterLevels(height_m, all.width(), all.height(), weather_.puddle_depth_m);
}

bool GroundTextures::IsUnderWater(std::size_t texel) const {
  return !water_m_.empty() && water_m_[texel] > heights_.at(texel);
}

/// Copies soil and state of the window from `terrain`. Returns the window of changes.
TexelWindow GroundTextures::ReadCovers(const TerrainSurface& terrain, const TexelWindow& window) {
  TexelWindow changed;
  for (int j = window.j0; j < window.j1; ++j) {
    for (int i = window.i0; i < window.i1; ++i) {
      TerrainSurface::Cover& cover = cover_[heights_.index(i, j)];
      const TerrainSurface::Cover now =
          terrain.at(i * heights_.texel_cells(), j * heights_.texel_cells()).cover;
      if (cover == now) continue;
      cover = now;
      changed.Extend(i, j);
    }
  }
  return changed;
}

void GroundTextures::PaintTexel(int i, int j, float sky) {
  const TerrainSurface::Cover cover = cover_[heights_.index(i, j)];
  const SoilAppearance& soil = soils_[std::min<std::size_t>(cover.soil, soils_.size() - 1)];
  const bool is_water = IsUnderWater(heights_.index(i, j));
  const double saturation = is_water ? 1.0 : cover.moisture / 255.0;
  const double loose = cover.looseness / 255.0;
  const double rut = cover.rut / 255.0;
  const double tone = SoilTone(saturation, loose) * (1 - kRutDarker * rut);
  const std::size_t at = 4 * heights_.index(i, j);
  std::uint8_t* albedo = &albedo_.levels[0].texels[at];
  Vec3 bare = tone * soil.albedo;
  if (paint_) {
    const Vec2 p_W_m = origin_W_m_ + heights_.texel_m() * Vec2(i, j);
    bare = paint_->Over(bare, p_W_m.x(), p_W_m.y(), heights_.at(i, j), loose);
  }
  albedo[3] = Unorm8(sky);

  const int il = std::max(i - 1, 0), ir = std::min(i + 1, heights_.width() - 1);
  const int jl = std::max(j - 1, 0), jr = std::min(j + 1, heights_.height() - 1);
  const double slope_x =
      (heights_.at(ir, j) - heights_.at(il, j)) / ((ir - il) * heights_.texel_m());
  const double slope_y =
      (heights_.at(i, jr) - heights_.at(i, jl)) / ((jr - jl) * heights_.texel_m());
  const Vec3 normal = Vec3(-slope_x, -slope_y, 1).normalized();
  const double snow = is_water ? 0.0 : SnowShare(weather_, cover, normal.z());
  for (int k = 0; k < 3; ++k) {
    albedo[k] = Unorm8(std::sqrt(std::max(bare[k] + snow * (kSnowAlbedo[k] - bare[k]), 0.0)));
  }
  const double grain = std::sqrt(std::clamp(soil.grain_size_m / kTypicalGrain_m, 0.05, 4.0)) *
                       (1 - kSnowSmooths * snow);
  std::uint8_t* shape = &shape_.levels[0].texels[at];
  shape[0] = Snorm8(normal.x());
  shape[1] = Snorm8(normal.y());
  shape[2] = Snorm8(loose);
  shape[3] = Snorm8(0.5 * grain * (kUndisturbedDetail + (1 - kUndisturbedDetail) * loose) *
                    (1 - 0.5 * rut));
  if (!is_water) return;
  shape[0] = shape[1] = shape[2] = 0;
  shape[3] = Snorm8(-1);
}

/// Paints each texel of the windows once. A texel depends on heights and covers only; adjacent
/// tiles share border texels.
void GroundTextures::Paint(const std::vector<TexelWindow>& windows, Workers* workers) {
  const std::vector<TexelRow> rows = RowsOf(windows);
  constexpr std::size_t kLeastRows = 8;
  workers->ForRanges(rows.size(), kLeastRows, [&](std::size_t begin, std::size_t end) {
    std::vector<float> sky;
    for (std::size_t r = begin; r < end; ++r) {
      const TexelRow& row = rows[r];
      sky.resize(static_cast<std::size_t>(row.i1 - row.i0));
      sky_view_.Factors(heights_, row, sky.data());
      for (int i = row.i0; i < row.i1; ++i) PaintTexel(i, row.j, sky[i - row.i0]);
    }
  });
}

void GroundTextures::Update(const TerrainSurface& terrain, const std::vector<TileIndex>& changed,
                            Workers* workers) {
  if (changed.empty()) return;
  // At least 1, because the normal uses adjacent texels.
  const int reach = std::max(sky_view_.reach_texels(), 1);
  const int halo = reach * heights_.texel_cells() / kCells + 1;  // in tiles
  std::vector<TexelWindow> dirty(terrain.tile_count());
  TexelWindow risen;
  for (const TileIndex& t : changed) {
    const TexelWindow tile = heights_.Of(t.x, t.y);
    const TexelWindow heights = heights_.Read(terrain, tile);
    TexelWindow seen = heights.Grown(reach);
    seen.Extend(ReadCovers(terrain, tile));
    if (!painted_) seen = tile;
    risen.Extend(heights);
    for (int b = std::max(t.y - halo, 0); b <= std::min(t.y + halo, terrain.tiles_y() - 1); ++b) {
      for (int a = std::max(t.x - halo, 0); a <= std::min(t.x + halo, terrain.tiles_x() - 1); ++a) {
        dirty[terrain.tile_index(a, b)].Extend(seen.Within(heights_.Of(a, b)));
      }
    }
  }
  Paint(dirty, workers);
  // Texels of smaller levels extend over several tiles, so they follow after all tiles.
  if (!painted_) dirty = {{0, 0, heights_.width(), heights_.height()}};
  painted_ = true;
  for (const TexelWindow& window : Gathered(dirty, kTexelsOfAWindow)) {
    albedo_.Send(window, workers);
    shape_.Send(window, workers);
  }
  SendShadow(shadow_.Update(heights_, risen));
}

void GroundTextures::SendShadow(const TexelWindow& w) const {
  if (w.empty()) return;
  glPixelStorei(GL_UNPACK_ROW_LENGTH, heights_.width());
  glTextureSubImage2D(shadow_texture_.id(), 0, w.i0, w.j0, w.i1 - w.i0, w.j1 - w.j0, GL_RED,
                      GL_FLOAT, &shadow_.shadow_m()[heights_.index(w.i0, w.j0)]);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
}

double GroundTextures::penumbra_m() const {
  constexpr double kLeast_m = 1e-3;
  const double along = to_sun_W_.head<2>().cwiseAbs().maxCoeff();
  return std::max(0.9 * heights_.texel_m() * to_sun_W_.z() / std::max(along, 1e-3), kLeast_m);
}

void GroundTextures::Bind(unsigned first, const Program& program) const {
  glBindTextureUnit(first, albedo_.texture.id());
  glBindTextureUnit(first + 1, shape_.texture.id());
  glBindTextureUnit(first + 2, shadow_texture_.id());
  const double texel_m = heights_.texel_m();
  const Vec2 size_m = texel_m * Vec2(heights_.width(), heights_.height());
  const Vec2 edge_m = origin_W_m_ - Vec2::Constant(0.5 * texel_m);  // outer edge of the first texel
  program.Set("u_ground_scale", Eigen::Vector2f(size_m.cwiseInverse().cast<float>()));
  program.Set("u_ground_origin", Eigen::Vector2f(edge_m.cast<float>()));
}

}  // namespace tera
