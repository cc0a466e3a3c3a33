#pragma once

#include <vector>

#include "render/scene.h"

namespace tera {

/// Record of the nodes' state in a drawn image. It shows whether a new draw is necessary.
class DrawnScene {
 public:
  DrawnScene() = default;
  explicit DrawnScene(const SceneState& state) : X_WB_(state.X_WB), shapes_(state.shapes) {}

  /// True if the poses of all bodies and all deforming meshes equal the recorded ones.
  bool IsOf(const SceneState& state) const;

 private:
  std::vector<Pose> X_WB_;
  Shapes shapes_;
};

}  // namespace tera
