#pragma once

#include <vector>

#include "render/air/falling_drops.h"
#include "render/gl/gl_objects.h"
#include "render/gl/passes/daylight.h"
#include "render/gl/pictures.h"
#include "render/gl/view.h"
#include "render/scene.h"

namespace tera {

/// Draws streaks of falling drops in front of an image.
///
/// Model   streaks as in FallingDrops. A drop refracts light from a wide cone, so its radiance is
///         kShare times the mean radiance around it.
/// Source  Garg and Nayar 2007, "Vision and rain", section 3 (about 0.94 of the mean radiance in a
///         cone of 165 degrees).
class RainPass {
 public:
  static constexpr double kShare = 0.94;

  explicit RainPass(const Weather& weather);
  void Draw(const View& view, const SceneState& state, const Daylight& daylight, const Pictures& p);

 private:
  FallingDrops drops_;
  Program program_{"rain.vert", "rain.frag"};
  GlObject vertices_, array_ = MakeVertexArray();
  std::size_t room_ = 0;                  ///< capacity of the buffer, in vertices
  std::vector<Eigen::Vector4f> corners_;  ///< image x, y, depth, and hidden fraction of light
};

}  // namespace tera
