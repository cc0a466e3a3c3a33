#pragma once

#include "render/gl/gl_objects.h"
#include "render/gl/passes/drawn_scene.h"
#include "render/gl/passes/node_renderer.h"
#include "render/scene.h"

namespace tera {

/// Shadows that the nodes cast from the sun. (The ground's own shadow is a texture of its own, see
/// GroundTextures.)
///
/// Frames  L sun's frame: z towards the sun, origin at W's.
/// Model   one depth texture with two orthographic pictures of the nodes side by side: a fine one
///         of those near the camera, a coarse one of all. Drawn again only when a node has moved:
///         what bodies that have never moved cast is kept for the last few places of the camera,
///         and what others cast drawn over a copy of it, which gives the same texels.
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
  /// The shadows of what stands, for pictures of these boxes.
  struct Standing {
    Eigen::AlignedBox3d near_box_L_m, far_box_L_m;
    GlObject texture, framebuffer;
  };
  void Cover(const Vec3& centre_W_m, const Eigen::AlignedBox3d& all_L_m);
  bool TakeMoved(const SceneState& state);
  const Standing& StandingFor(const NodeRenderer& nodes);
  void Draw(const GlObject& framebuffer, const NodeRenderer& nodes, bool standing) const;
  void AimAt(const Picture& picture) const;

  Mat3 R_LW_;
  Program program_{"shadow.vert", "shadow.frag"};
  GlObject texture_, framebuffer_;
  Picture near_, far_;
  std::vector<Standing> standing_;  ///< the one used last at the end
  std::vector<Pose> first_poses_;
  std::vector<bool> has_moved_;  ///< for each body
  DrawnScene drawn_;
  Vec3 drawn_centre_W_m_ = Vec3::Zero();
};

}  // namespace tera
