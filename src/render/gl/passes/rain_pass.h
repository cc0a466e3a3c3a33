#pragma once

#include <vector>

#include "render/air/falling_drops.h"
#include "render/gl/gl_objects.h"
#include "render/gl/passes/daylight.h"
#include "render/gl/pictures.h"
#include "render/gl/view.h"
#include "render/scene.h"

namespace tera {

/// Streaks of falling drops over a picture, before what is behind them.
///
/// Model   FallingDrops; a drop shines with kShare of the mean radiance around it, which it gathers
///         from a wide cone.
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
  std::size_t room_ = 0;                  ///< vertices that the buffer holds
  std::vector<Eigen::Vector4f> corners_;  ///< x, y and depth of the picture, share covered
};

}  // namespace tera
