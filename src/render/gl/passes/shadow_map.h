#pragma once

#include "render/gl/gl_objects.h"
#include "render/gl/passes/node_renderer.h"
#include "render/scene.h"

namespace tera {

/// Shadows that the nodes cast from the sun. (The ground's own shadow is a texture of its own, see
/// GroundTextures.)
///
/// Frames  L sun's frame: z towards the sun, origin at W's.
/// Model   one depth texture with two orthographic pictures of the nodes side by side: a fine one
///         of those near the camera, a coarse one of all. Drawn again only when a node has moved.
class ShadowMap {
 public:
  explicit ShadowMap(const Vec3& to_sun_W);

  void Update(const SceneState& state, const Vec3& eye_W_m, NodeRenderer* nodes);
  /// Binds the texture to `unit` and tells `program` how positions relative to the eye map to it.
  void Bind(unsigned unit, const Vec3& eye_W_m, const Program& program) const;

 private:
  struct Picture {
    int left_px, side_px;         ///< its square in the texture
    Eigen::AlignedBox3d box_L_m;  ///< what it covers
  };
  void AimAt(const Picture& picture) const;

  Mat3 R_LW_;
  Program program_{"shadow.vert", "shadow.frag"};
  GlObject texture_, framebuffer_;
  Picture near_, far_;
  bool drawn_ = false;
  std::vector<Pose> drawn_poses_;
  Shapes drawn_shapes_;
  Vec3 drawn_centre_W_m_ = Vec3::Zero();
};

}  // namespace tera
