#pragma once

#include <array>

#include "core/types/terrain_surface.h"
#include "core/workers.h"
#include "render/gl/gl_objects.h"
#include "render/gl/view.h"
#include "render/ground/apron.h"
#include "render/ground/ground_textures.h"
#include "render/ground/tile_pool.h"
#include "render/scene.h"

namespace tera {

/// Draws the ground tile by tile.
///
/// Model   a tile skips vertices: it uses the largest stride whose maximum height error is below
///         kErrorPx in the image and below kErrorM. A tile is uploaded again only when its version
///         changes. Undisturbed tiles have few vertices.
class TerrainRenderer {
 public:
  /// `workers` compute the ground's textures. They must outlive this object.
  TerrainRenderer(const SceneModel& model, const Vec3& to_sun_W, Workers* workers);

  /// Updates the GPU's copy of `terrain`.
  void Update(const TerrainSurface& terrain);
  /// Draws the tiles in `view`, near to far, and the land around the site.
  void Draw(const View& view) const;
  const GroundTextures& textures() const { return textures_; }

  /// Tiles sent to the GPU since construction.
  std::int64_t uploaded_tiles() const { return uploaded_tiles_; }
  /// Triangles since construction.
  std::int64_t triangles_drawn() const { return triangles_drawn_; }

 private:
  struct Tile {
    std::uint32_t version = 0;
    int pool = -1, place = 0;
    Eigen::AlignedBox3d box_W_m;
    /// Height error by stride; infinite for a stride that does not divide the tile.
    std::array<float, kTileStrides.size()> error_m{};

    void Measure(const TileGrid& grid);
    int StrideFor(double distance_m, double fy_px) const;
  };

  void Restart(const TerrainSurface& terrain);
  void UploadTiles(const TerrainSurface& terrain, const std::vector<TileIndex>& changed);
  void DrawTiles(const View& view) const;
  void DrawApron(const View& view) const;

  const std::vector<SoilAppearance> soils_;
  const std::shared_ptr<const GroundPaint> paint_;
  const Weather weather_;
  Workers* workers_;
  TerrainGrid grid_;
  std::vector<Tile> tiles_;
  std::vector<TilePool> pools_;  ///< by resolution of the tiles: refined, undisturbed
  GlObject detail_;
  GroundTextures textures_;
  Apron apron_;
  /// Factor on the land's albedo: rain darkens it like the ground at the border.
  double apron_tone_ = 1;
  Vec3 to_sun_W_;
  Program ground_program_{"terrain.vert", "terrain.frag"};
  Program apron_program_{"apron.vert", "apron.frag"};
  std::int64_t uploaded_tiles_ = 0;
  mutable std::int64_t triangles_drawn_ = 0;
};

}  // namespace tera
