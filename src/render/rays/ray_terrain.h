#pragma once

#include <cstdint>
#include <vector>

#include "render/ground/surroundings.h"
#include "render/rays/embree_objects.h"
#include "render/scene.h"

namespace tera {

/// The ground in an Embree scene: one geometry per terrain tile, and one for the surrounding land.
/// An update rebuilds only tiles with a new version. Undisturbed tiles have the fewest possible
/// quads. Clods in the air form one geometry, which each update rebuilds.
class RayTerrain {
 public:
  /// Adds its geometries to `scene` and removes them. The owner of the scene commits it.
  RayTerrain(RTCDevice device, RTCScene scene, const SceneModel& model)
      : device_(device), scene_(scene), soils_(model.soils), weather_(model.environment.weather) {}

  void Update(const TerrainSurface& terrain);

  /// Diffuse reflectance of a primitive of a ground geometry, 0..1.
  float ReflectanceAt(unsigned geometry, unsigned primitive) const;

  /// Number of tiles built since construction.
  std::int64_t tiles_rebuilt() const { return tiles_rebuilt_; }

 private:
  struct Patch {
    EmbreeGeometry geometry;
    unsigned id = RTC_INVALID_GEOMETRY_ID;
    std::uint32_t version = 0;
    int step_cells = 0;              ///< vertex spacing of the geometry, in cells
    std::vector<float> reflectance;  ///< one per primitive
  };
  void Restart(const TerrainSurface& terrain);
  void Attach(Patch* patch);
  void NewTile(Patch* tile, int squares_x, int squares_y);
  void RebuildTile(const TerrainSurface& terrain, int a, int b);
  void RebuildLand(const TerrainSurface& terrain);
  void RebuildGrains(const TerrainSurface& terrain);
  void Detach(Patch* patch);
  float Reflectance(std::uint8_t soil, double saturation) const;
  float ReflectanceAt(const TerrainSurface& terrain, int i, int j) const;

  RTCDevice device_;
  RTCScene scene_;
  std::vector<SoilAppearance> soils_;
  Weather weather_;
  std::vector<Patch> tiles_;
  Surroundings surroundings_;
  Patch land_, grains_;
  std::vector<const Patch*> patch_of_;  ///< by geometry id; null for other geometry
  TerrainGrid grid_;
  std::int64_t tiles_rebuilt_ = 0;
};

}  // namespace tera
