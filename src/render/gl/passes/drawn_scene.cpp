#include "render/gl/passes/drawn_scene.h"

#include <algorithm>

namespace tera {

bool DrawnScene::IsOf(const SceneState& state) const {
  return !X_WB_.empty() &&
         std::equal(X_WB_.begin(), X_WB_.end(), state.X_WB.begin(), state.X_WB.end(),
                    [](const Pose& p, const Pose& q) { return p.matrix() == q.matrix(); }) &&
         std::equal(shapes_.begin(), shapes_.end(), state.shapes.begin(), state.shapes.end(),
                    [](const auto& p, const auto& q) { return AreAlike(p.get(), q.get()); });
}

}  // namespace tera
