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

/// A tile of the ground by its place in the grid of tiles.
struct TileIndex {
  int x = 0, y = 0;
};

/// Textures of the whole site, one texel for each vertex (of a site too large for one texture, for
/// every second, third ...), that give the ground its looks: colour with sky factor, shape (slope
/// of the normal, looseness, roughness of the detail), and the height of the ground's own shadow.
///
/// Model   albedo by soil; moisture darkens it as R = Rs + (Rd - Rs) exp(-c S), S the degree of
///         saturation, with Rs a fixed share of the dry albedo; loose soil is a little lighter,
///         pressed ruts darker; a paint of the site, if there is one, lies over what is as it was.
///         Smaller levels of each texture are means of four texels. Only texels that have changed,
///         see others that have, or lie in a changed shadow are remade. Rain saturates the surface,
///         snow covers it (ground_cover.h), water stands in hollows (hollows.h): its shape is
///         level, and its detail's roughness, negative, says that it is water.
/// Source  Lobell, Asner 2002, "Moisture effects on soil reflectance", eq. 1.
class GroundTextures {
 public:
  GroundTextures() = default;
  /// Water stands in the hollows that `terrain` has.
  GroundTextures(const TerrainSurface& terrain, const std::vector<SoilAppearance>& soils,
                 std::shared_ptr<const GroundPaint> paint, const Weather& weather,
                 const Vec3& to_sun_W);

  /// Takes over the changed tiles.
  void Update(const TerrainSurface& terrain, const std::vector<TileIndex>& changed,
              Workers* workers);
  /// Colour, shape and shadow to texture units `first` to `first + 2`; tells `program` how to look
  /// them up (u_ground_scale, u_ground_origin).
  void Bind(unsigned first, const Program& program) const;
  /// Height over which the ground's shadow fades: less than its own drop from vertex to vertex, so
  /// that level ground does not shade itself.
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
    /// Remakes smaller levels below the texels and sends them.
    void Send(TexelWindow window, Workers* workers);

   private:
    void Shrink(int level, const TexelWindow& window, Workers* workers);
    void ShrinkRows(int level, const TexelWindow& window);
    void Upload(int level, const TexelWindow& window) const;
  };

  TexelWindow ReadCovers(const TerrainSurface& terrain, const TexelWindow& window);
  void Paint(const std::vector<TexelWindow>& windows, Workers* workers);
  /// `sky` is the share of its light that reaches the texel.
  void PaintTexel(int i, int j, float sky);
  bool IsUnderWater(std::size_t texel) const;
  void SendShadow(const TexelWindow& window) const;

  std::vector<SoilAppearance> soils_;
  std::shared_ptr<const GroundPaint> paint_;
  Weather weather_;
  Vec3 to_sun_W_ = Vec3::UnitZ();
  Vec2 origin_W_m_ = Vec2::Zero();
  HeightTexels heights_;
  std::vector<TerrainSurface::Cover> cover_;  ///< of each texel
  std::vector<float> water_m_;  ///< level in each texel's hollow; empty where no water stands
  bool painted_ = false;        ///< whole, once
  SkyView sky_view_;
  GroundShadow shadow_;
  Pyramid albedo_, shape_;
  GlObject shadow_texture_;
};

}  // namespace tera
