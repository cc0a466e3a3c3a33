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

/// A terrain tile by its position in the tile grid.
struct TileIndex {
  int x = 0, y = 0;
};

/// Textures of the whole site for the ground's appearance, one texel per vertex. A site too large
/// for one texture uses every second, third ... vertex. The textures hold colour with sky factor,
/// shape (slope of the normal, looseness, roughness of the detail), and shadow height.
///
/// Model   albedo by soil. Moisture darkens it as R = Rs + (Rd - Rs) exp(-c S), where S is the
///         degree of saturation and Rs a fixed fraction of the dry albedo. Loose soil is slightly
///         lighter, pressed ruts are darker. A paint of the site covers undisturbed ground. Mipmap
///         levels are means of four texels. Updates recompute only texels that changed, see changed
///         texels, or lie in a changed shadow. Rain saturates the surface, snow covers it
///         (ground_cover.h) and water stands in hollows (hollows.h). Water has a level shape; a
///         negative detail roughness marks it.
/// Source  Lobell, Asner 2002, "Moisture effects on soil reflectance", eq. 1.
class GroundTextures {
 public:
  GroundTextures() = default;
  /// Water stands in the hollows of `terrain`.
  GroundTextures(const TerrainSurface& terrain, const std::vector<SoilAppearance>& soils,
                 std::shared_ptr<const GroundPaint> paint, const Weather& weather,
                 const Vec3& to_sun_W);

  /// Copies the changed tiles.
  void Update(const TerrainSurface& terrain, const std::vector<TileIndex>& changed,
              Workers* workers);
  /// Binds colour, shape and shadow to texture units `first` to `first + 2`. Sets the lookup
  /// uniforms u_ground_scale and u_ground_origin of `program`.
  void Bind(unsigned first, const Program& program) const;
  /// Height over which the ground's shadow fades. It is less than the shadow's drop between
  /// vertices, so that level ground does not shade itself.
  double penumbra_m() const;

 private:
  /// A four-channel texture with a copy of its levels.
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
    /// Recomputes the smaller levels of the texels and uploads them.
    void Send(TexelWindow window, Workers* workers);

   private:
    void Shrink(int level, const TexelWindow& window, Workers* workers);
    void ShrinkRows(int level, const TexelWindow& window);
    void Upload(int level, const TexelWindow& window) const;
  };

  TexelWindow ReadCovers(const TerrainSurface& terrain, const TexelWindow& window);
  void Paint(const std::vector<TexelWindow>& windows, Workers* workers);
  /// `sky` is the fraction of the sky's light that reaches the texel.
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
  std::vector<float> water_m_;  ///< level in each texel's hollow; empty without standing water
  bool painted_ = false;        ///< true after the first complete paint
  SkyView sky_view_;
  GroundShadow shadow_;
  Pyramid albedo_, shape_;
  GlObject shadow_texture_;
};

}  // namespace tera
