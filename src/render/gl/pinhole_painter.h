#pragma once

#include <functional>
#include <optional>

#include "core/workers.h"
#include "render/gl/passes/daylight.h"
#include "render/gl/passes/dust_pass.h"
#include "render/gl/passes/geometry_pass.h"
#include "render/gl/passes/grain_renderer.h"
#include "render/gl/passes/lamp_lights.h"
#include "render/gl/passes/light_pass.h"
#include "render/gl/passes/node_renderer.h"
#include "render/gl/passes/rain_pass.h"
#include "render/gl/passes/shading_pass.h"
#include "render/gl/passes/shadow_map.h"
#include "render/gl/passes/sky_and_glass.h"
#include "render/gl/passes/tone_pass.h"
#include "render/gl/pictures.h"
#include "render/gl/view.h"
#include "render/ground/terrain_renderer.h"
#include "render/scene.h"

namespace tera {

/// Draws pinhole images of one scene, pass by pass.
///
/// Model   deferred shading in four steps: visible surfaces; lighting; sky, glass and airborne
///         matter; tone curve.
class PinholePainter {
 public:
  /// Calls `done` with the name of each pass after its draw calls. `model` and `workers` must
  /// outlive this object.
  PinholePainter(const SceneModel& model, Workers* workers,
                 std::function<void(const char* pass)> done);

  /// Sets the luminance that maps to 1. If empty, the scene's exposure determines it.
  void SetWhite(std::optional<double> white_cdpm2) { daylight_.SetWhite(white_cdpm2); }
  /// Draws the scene of `state` into `p`. Also writes the illuminance of the visible surfaces to
  /// `light` unless it is null.
  void Draw(const View& view, const SceneState& state, const Pictures& p, LightPass* light);

  const Daylight& daylight() const { return daylight_; }
  NodeRenderer& nodes() { return nodes_; }
  const TerrainRenderer& terrain() const { return terrain_; }
  /// The clods of the last image; null without ground.
  const GrainRenderer* grains() const { return has_ground_ ? &grains_ : nullptr; }
  /// Triangles sent to the GPU since construction.
  std::int64_t triangles_drawn() const;

 private:
  void TakeScene(const View& view, const SceneState& state);
  void DrawAir(const View& view, const SceneState& state, const Pictures& p);

  std::function<void(const char* pass)> done_;
  Daylight daylight_;
  NodeRenderer nodes_;
  TerrainRenderer terrain_;
  GrainRenderer grains_;
  ShadowMap shadow_map_;
  LampLights lamps_;
  GeometryPass geometry_;
  ShadingPass shading_;
  SkyAndGlass sky_and_glass_;
  std::optional<DustPass> dust_;  ///< created with the first airborne dust
  std::optional<RainPass> rain_;  ///< empty without rain
  TonePass tone_;
  bool has_ground_ = false;
};

}  // namespace tera
