#pragma once

#include "render/gl/gl_objects.h"
#include "render/gl/passes/drawn_scene.h"
#include "render/gl/passes/node_renderer.h"
#include "render/scene.h"

namespace tera {

/// Shadows that the sun casts by the nodes. GroundTextures holds the shadow of the ground.
///
/// Frames  L has its origin at that of W, and z towards the sun.
/// Model   one depth texture contains two orthographic images of the nodes: a fine one near the
///         camera and a coarse one of all nodes. It is redrawn only when a node or the camera has
///         moved.
///         Shadows of static bodies are cached for the last few camera positions. Moving bodies are
///         drawn over a copy of the cache; the texels equal those of a full redraw.
class ShadowMap {
 public:
  explicit ShadowMap(const Vec3& to_sun_W);

  void Update(const SceneState& state, const Vec3& eye_W_m, NodeRenderer* nodes);
  /// Binds the texture to `unit`. Sets the uniforms that map eye-relative positions to it.
  void Bind(unsigned unit, const Vec3& eye_W_m, const Program& program) const;

 private:
  struct Picture {
    int left_px, side_px;         ///< square of this image in the texture
    Eigen::AlignedBox3d box_L_m;  ///< volume that the image shows
  };
  /// Cached shadows of the static nodes, for a fine and a coarse image of these volumes.
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
  std::vector<Standing> standing_;  ///< most recently used last
  std::vector<Pose> first_poses_;
  std::vector<bool> has_moved_;  ///< one per body
  DrawnScene drawn_;
  Vec3 drawn_centre_W_m_ = Vec3::Zero();
};

}  // namespace tera
