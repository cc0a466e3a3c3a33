#pragma once

#include <vector>

#include "render/scene.h"

namespace tera {

/// What a picture of the nodes was drawn from, so that it need not be drawn again.
class DrawnScene {
 public:
  /// Nothing was drawn yet.
  DrawnScene() = default;
  explicit DrawnScene(const SceneState& state) : X_WB_(state.X_WB), shapes_(state.shapes) {}

  /// Whether all bodies stand there, and all meshes that change are as they were.
  bool IsOf(const SceneState& state) const;

 private:
  std::vector<Pose> X_WB_;
  Shapes shapes_;
};

}  // namespace tera
