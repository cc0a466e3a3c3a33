#include "render/ground_textures.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>

#include "render/soil_colour.h"

namespace tera {
namespace {

constexpr int kCells = TerrainSurface::kTileCells;
constexpr double kRutDarker = 0.22;
constexpr double kTypicalGrain_m = 0.01;
constexpr float kUndisturbedDetail = 0.45f;  // of the relief of loose soil

std::uint8_t Unorm8(double value) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 1.0) * 255.0));
}

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

void GroundTextures::Pyramid::Shrink(int level, int i0, int j0, int i1, int j1) {
  const Level& fine = levels[level - 1];
  Level& coarse = levels[level];
  for (int j = j0; j < j1; ++j) {
    for (int i = i0; i < i1; ++i) {
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
        const int mean = static_cast<int>(std::floor((sum + 2) / 4.0));
        coarse.texels[(static_cast<std::size_t>(j) * coarse.width + i) * 4 + k] =
            static_cast<std::uint8_t>(mean);
      }
    }
  }
}

void GroundTextures::Pyramid::Upload(int level, int i0, int j0, int i1, int j1) const {
  const Level& l = levels[level];
  glPixelStorei(GL_UNPACK_ROW_LENGTH, l.width);
  glTextureSubImage2D(texture.id(), level, i0, j0, i1 - i0, j1 - j0, GL_RGBA,
                      is_signed ? GL_BYTE : GL_UNSIGNED_BYTE,
                      &l.texels[(static_cast<std::size_t>(j0) * l.width + i0) * 4]);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
}

void GroundTextures::Pyramid::Send(int i0, int j0, int i1, int j1) {
  Upload(0, i0, j0, i1, j1);
  for (int level = 1; level < static_cast<int>(levels.size()); ++level) {
    const Level& l = levels[level];
    i0 = std::min(i0 / 2, l.width - 1);
    j0 = std::min(j0 / 2, l.height - 1);
    i1 = std::clamp((i1 + 1) / 2, i0 + 1, l.width);
    j1 = std::clamp((j1 + 1) / 2, j0 + 1, l.height);
    Shrink(level, i0, j0, i1, j1);
    Upload(level, i0, j0, i1, j1);
  }
}

GroundTextures::GroundTextures(const TerrainSurface& terrain,
                               const std::vector<SoilAppearance>& soils, const Vec3& to_sun_W)
    : soils_(soils),
      to_sun_W_(to_sun_W),
      origin_W_m_(terrain.origin_W_m),
      cell_m_(terrain.cell_m),
      sky_view_(terrain.cell_m),
      nx_(terrain.nx),
      ny_(terrain.ny),
      albedo_(nx_, ny_, false),
      shape_(nx_, ny_, true) {
  if (soils_.empty()) soils_.push_back(SoilAppearance{});
  shadow_ = MakeTexture(GL_R32F, nx_, ny_, Filter::kLinear, Wrap::kClamp);
}

void GroundTextures::PaintVertex(const TerrainSurface& terrain, int i, int j) {
  const std::size_t v = terrain.index(i, j);
  const SoilAppearance& soil = soils_[std::min<std::size_t>(terrain.soil[v], soils_.size() - 1)];
  const double saturation = terrain.moisture[v] / 255.0, loose = terrain.looseness[v] / 255.0;
  const double rut = terrain.rut[v] / 255.0;
  const double tone = SoilTone(saturation, loose) * (1 - kRutDarker * rut);
  std::uint8_t* albedo = &albedo_.levels[0].texels[v * 4];
  for (int k = 0; k < 3; ++k) albedo[k] = Unorm8(std::sqrt(std::max(soil.albedo[k] * tone, 0.0)));
  albedo[3] = Unorm8(sky_view_.Factor(terrain, i, j));

  const int il = std::max(i - 1, 0), ir = std::min(i + 1, nx_ - 1);
  const int jl = std::max(j - 1, 0), jr = std::min(j + 1, ny_ - 1);
  const std::vector<float>& h = terrain.height_m;
  const double slope_x =
      (h[terrain.index(ir, j)] - h[terrain.index(il, j)]) / ((ir - il) * cell_m_);
  const double slope_y =
      (h[terrain.index(i, jr)] - h[terrain.index(i, jl)]) / ((jr - jl) * cell_m_);
  const Vec3 normal = Vec3(-slope_x, -slope_y, 1).normalized();
  const double grain = std::sqrt(std::clamp(soil.grain_size_m / kTypicalGrain_m, 0.05, 4.0));
  std::uint8_t* shape = &shape_.levels[0].texels[v * 4];
  shape[0] = Snorm8(normal.x());
  shape[1] = Snorm8(normal.y());
  shape[2] = Snorm8(loose);
  shape[3] = Snorm8(0.5 * grain * (kUndisturbedDetail + (1 - kUndisturbedDetail) * loose) *
                    (1 - 0.5 * rut));
}

void GroundTextures::Update(const TerrainSurface& terrain, const std::vector<TileIndex>& changed) {
  if (changed.empty()) return;
  // The sky factor of neighbouring tiles within reach changes too.
  const int tiles_x = terrain.tiles_x(), tiles_y = terrain.tiles_y();
  const int halo = static_cast<int>(std::ceil(kOcclusionReach_m / (kCells * terrain.cell_m)));
  std::vector<bool> touched(static_cast<std::size_t>(tiles_x) * tiles_y, false);
  for (const TileIndex& t : changed) {
    for (int y = std::max(t.y - halo, 0); y <= std::min(t.y + halo, tiles_y - 1); ++y) {
      for (int x = std::max(t.x - halo, 0); x <= std::min(t.x + halo, tiles_x - 1); ++x) {
        touched[static_cast<std::size_t>(y) * tiles_x + x] = true;
      }
    }
  }
  for (int y = 0; y < tiles_y; ++y) {
    for (int x = 0; x < tiles_x; ++x) {
      if (!touched[static_cast<std::size_t>(y) * tiles_x + x]) continue;
      const int i0 = x * kCells, i1 = std::min(i0 + kCells + 1, nx_);
      const int j0 = y * kCells, j1 = std::min(j0 + kCells + 1, ny_);
      for (int j = j0; j < j1; ++j) {
        for (int i = i0; i < i1; ++i) PaintVertex(terrain, i, j);
      }
    }
  }
  // Smaller levels straddle tiles, so that they are remade after all tiles are painted.
  for (int y = 0; y < tiles_y; ++y) {
    for (int x = 0; x < tiles_x; ++x) {
      if (!touched[static_cast<std::size_t>(y) * tiles_x + x]) continue;
      const int i0 = x * kCells, i1 = std::min(i0 + kCells + 1, nx_);
      const int j0 = y * kCells, j1 = std::min(j0 + kCells + 1, ny_);
      albedo_.Send(i0, j0, i1, j1);
      shape_.Send(i0, j0, i1, j1);
    }
  }
  const std::vector<float> shadow = ShadowHeights(terrain, to_sun_W_);
  glTextureSubImage2D(shadow_.id(), 0, 0, 0, nx_, ny_, GL_RED, GL_FLOAT, shadow.data());
}

double GroundTextures::penumbra_m() const {
  constexpr double kLeast_m = 1e-3;
  const double along = to_sun_W_.head<2>().cwiseAbs().maxCoeff();
  return std::max(0.9 * cell_m_ * to_sun_W_.z() / std::max(along, 1e-3), kLeast_m);
}

void GroundTextures::Bind(unsigned first, const Program& program) const {
  glBindTextureUnit(first, albedo_.texture.id());
  glBindTextureUnit(first + 1, shape_.texture.id());
  glBindTextureUnit(first + 2, shadow_.id());
  const Vec2 size_m = cell_m_ * Vec2(nx_, ny_);
  const Vec2 edge_m = origin_W_m_ - Vec2::Constant(0.5 * cell_m_);  // of the first texel
  program.Set("u_ground_scale", Eigen::Vector2f(size_m.cwiseInverse().cast<float>()));
  program.Set("u_ground_origin", Eigen::Vector2f(edge_m.cast<float>()));
}

}  // namespace tera
