#pragma once

#include <array>

#include "core/terrain_surface.h"
#include "render/apron.h"
#include "render/gl_objects.h"
#include "render/ground_textures.h"
#include "render/scene.h"
#include "render/view.h"

namespace tera {

/// Draws the ground tile by tile.
///
/// Model   each tile is a grid of vertices with index lists for strides 1, 2, 5, 10, 25 and 50
///         squares, and a skirt hanging from its border that closes the cracks between strides. A
///         tile is drawn with the largest stride whose greatest height error is seen below
///         kErrorPx and is below kErrorM. Heights, colours and normals of a tile are sent again
///         only when its version has changed.
class TerrainRenderer {
 public:
  TerrainRenderer(const SceneModel& model, const Vec3& to_sun_W);

  /// Brings the GPU's copy up to date with `terrain`.
  void Update(const TerrainSurface& terrain);
  /// Draws the tiles that `view` sees, near to far, and the land around the site.
  void Draw(const View& view) const;
  const GroundTextures& textures() const { return textures_; }

  /// Tiles sent to the GPU since construction.
  std::int64_t uploaded_tiles() const { return uploaded_tiles_; }
  /// Since construction.
  std::int64_t triangles_drawn() const { return triangles_drawn_; }

 private:
  static constexpr std::array<int, 6> kStrides = {1, 2, 5, 10, 25, 50};

  struct Tile {
    bool uploaded = false;
    std::uint32_t version = 0;
    Vec3 box_min_W_m = Vec3::Zero(), box_max_W_m = Vec3::Zero();
    std::array<float, kStrides.size()> error_m{};
  };
  struct IndexRange {
    std::size_t offset_bytes = 0;
    int count = 0;
  };

  void Allocate(const TerrainSurface& terrain);
  void UploadTile(const TerrainSurface& terrain, int tile_x, int tile_y);
  void DrawTiles(const View& view) const;
  void DrawApron(const View& view) const;

  const std::vector<SoilAppearance> soils_;
  int nx_ = 0, ny_ = 0, tiles_x_ = 0, tiles_y_ = 0;
  double cell_m_ = 0;
  Vec2 origin_W_m_ = Vec2::Zero();
  std::vector<Tile> tiles_;
  std::array<IndexRange, kStrides.size()> ranges_;
  GlObject vertices_, indices_, array_, detail_;
  GroundTextures textures_;
  Apron apron_;
  Vec3 to_sun_W_;
  Program ground_program_{"terrain.vert", "terrain.frag"};
  Program apron_program_{"apron.vert", "apron.frag"};
  std::int64_t uploaded_tiles_ = 0;
  mutable std::int64_t triangles_drawn_ = 0;
};

}  // namespace tera
