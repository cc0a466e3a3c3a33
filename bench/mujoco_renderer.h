#pragma once

#include <mujoco/mujoco.h>

#include <memory>

#include "core/types/measurement.h"
#include "mujoco_model.h"
#include "render/gl/camera_intrinsics.h"
#include "render/scene.h"

namespace tera::bench {

/// A scene in MuJoCo's own renderer, in an OpenGL context without a display, separate from TERA's.
///
/// Model   every triangle of the scene's nodes, one MuJoCo mesh for each mesh part, on mocap bodies
///         that follow the scene's; one directional light, whose shadow map has as many texels as
///         TERA's two; sky; no multisampling. The ground is a height field of every
///         kGroundStride-th vertex at the start, about as many triangles as TERA's levels of
///         detail.
/// Omits   changing ground, soil in shovels, glass, land around the site, lenses.
class MujocoRenderer {
 public:
  static constexpr int kGroundStride = 5;

  MujocoRenderer(const SceneModel& scene, const TerrainSurface& ground, int width_px,
                 int height_px);
  ~MujocoRenderer();

  enum class Output { kColourAndDepth, kAndSegments };
  /// Renders a pinhole camera at X_WC and reads it back, row 0 at the bottom.
  void Render(const CameraIntrinsics& camera, const Pose& X_WC, const SceneState& state,
              Output output);
  /// Triangles of the meshes and the height field.
  std::int64_t triangles() const { return triangles_; }

 private:
  struct Gl;
  std::unique_ptr<Gl> gl_;
  MujocoModel model_;
  MujocoData data_;
  std::vector<int> body_of_mocap_;
  mjvScene scene_;
  mjvOption option_;
  mjrContext context_;
  Image<std::uint8_t> rgb_, segments_;
  Image<float> depth_;
  std::int64_t triangles_ = 0;
};

}  // namespace tera::bench
