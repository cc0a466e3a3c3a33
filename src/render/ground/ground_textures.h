#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/types/terrain_surface.h"
#include "core/workers.h"
#include "render/gl/gl_objects.h"
#include "render/ground/ground_light.h"
#include "render/scene.h"

namespace tera {

/// Index of a terrain tile.
struct TileIndex {
  int x = 0, y = 0;
};

/// Textures of the ground's appearance over the whole site: colour with sky factor; shape (slope of
/// the normal, looseness, roughness of the detail); shadow height. There is one texel per terrain
/// vertex, or per second, third ... vertex if the site is too large for a texture.
///
/// Model   albedo by soil. Moisture darkens it: R = Rs + (Rd - Rs) exp(-c S), where S is the degree
///         of saturation, Rd the dry albedo and Rs a fixed fraction of it. Loose soil is slightly
///         lighter, pressed ruts are darker. A GroundPaint covers undisturbed ground.
///         Weather: rain saturates the surface, snow covers it (ground_cover.h), and water stands
///         in hollows (hollows.h). Water is level; a negative roughness of the detail marks it.
///         Mipmap texels are means of four texels. An update recomputes only texels that changed,
///         that have a changed texel within the reach of their sky factor, or whose shadow changed.
/// Source  Lobell, Asner 2002, "Moisture effects on soil reflectance", eq. 1.
class GroundTextures {
 public:
  GroundTextures() = default;
  /// Computes the water in the hollows of `terrain`, which stays constant.
  GroundTextures(const TerrainSurface& terrain, const std::vector<SoilAppearance>& soils,
                 std::shared_ptr<const GroundPaint> paint, const Weather& weather,
                 const Vec3& to_sun_W);

  /// Updates the textures for the changed tiles.
  void Update(const TerrainSurface& terrain, const std::vector<TileIndex>& changed,
              Workers* workers);
  /// Binds colour, shape and shadow to texture units `first` to `first + 2`. Sets the uniforms
  /// u_ground_scale and u_ground_origin, which convert positions to texture coordinates.
  void Bind(unsigned first, const Program& program) const;
  /// Height range over which the ground's shadow fades out. It is less than the fall of the shadow
  /// between two vertices, so that level ground does not shade itself.
  double penumbra_m() const;

 private:
  /// A four-channel texture with mipmaps, and a copy of them on the CPU.
  struct Pyramid {
    struct Level {
      int width = 0, height = 0;
      std::vector<std::uint8_t> texels;
    };
    std::vector<Level> levels;
    bool is_signed = false;
    GlObject texture;

    Pyramid() = default;
    Pyramid(int width, int height, bool holds_signed);
    /// Recomputes the mipmaps of the changed window and uploads all levels.
    void Send(TexelWindow window, Workers* workers);

   private:
    void Shrink(int level, const TexelWindow& window, Workers* workers);
    void ShrinkRows(int level, const TexelWindow& window);
    void Upload(int level, const TexelWindow& window) const;
  };

  TexelWindow ReadCovers(const TerrainSurface& terrain, const TexelWindow& window);
  void Paint(const std::vector<TexelWindow>& windows, Workers* workers);
  /// `sky` is the fraction of the sky's light at the texel.
  void PaintTexel(int i, int j, float sky);
  bool IsUnderWater(std::size_t texel) const;
  void SendShadow(const TexelWindow& window) const;

  std::vector<SoilAppearance> soils_;
  std::shared_ptr<const GroundPaint> paint_;
  Weather weather_;
  Vec3 to_sun_W_ = Vec3::UnitZ();
  Vec2 origin_W_m_ = Vec2::Zero();
  HeightTexels heights_;
  std::vector<TerrainSurface::Cover> cover_;  ///< one per texel
  /// Water level of the hollow at each texel; empty without standing water.
  std::vector<float> water_m_;
  bool painted_ = false;  ///< false before the first complete paint
  SkyView sky_view_;
  GroundShadow shadow_;
  Pyramid albedo_, shape_;
  GlObject shadow_texture_;
};

}  // namespace tera
