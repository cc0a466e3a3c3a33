#pragma once

#include <vector>

#include "render/scene.h"

namespace tera {

/// State of the nodes in a drawn image, to avoid a redundant draw.
class DrawnScene {
 public:
  /// No state.
  DrawnScene() = default;
  explicit DrawnScene(const SceneState& state) : X_WB_(state.X_WB), shapes_(state.shapes) {}

  /// True if all bodies and deforming meshes equal the drawn state.
  bool IsOf(const SceneState& state) const;

 private:
  std::vector<Pose> X_WB_;
  Shapes shapes_;
};

}  // namespace tera
