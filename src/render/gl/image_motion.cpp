#include "render/gl/image_motion.h"

#include <algorithm>
#include <optional>

namespace tera {
namespace {

constexpr int kProbe_px = 4;

/// For each instance: the transforms of its bodies from C at `then` to C at `other`.
using Carried = std::vector<std::vector<Pose>>;

Carried CarriedBy(const SceneModel& model, const PosedView& then, const PosedView& other) {
  const Pose X_DW = other.X_WC.inverse();
  Carried carried(std::max<std::size_t>(model.instances.size(), 1));
  std::vector<int> last_body(carried.size(), -1);
  for (const SceneNode& node : model.nodes) {
    if (last_body[node.instance] == node.body) continue;  // nodes of one body are consecutive
    last_body[node.instance] = node.body;
    carried[node.instance].push_back(X_DW * other.X_WB[node.body] * then.X_WB[node.body].inverse() *
                                     then.X_WC);
  }
  carried[0].assign(1, X_DW * then.X_WC);
  return carried;
}

}  // namespace

double ImageMotion_px(const SceneModel& model, const CameraIntrinsics& lens,
                      const CameraFrame& frame, const PosedView& then, const PosedView& other) {
  const Carried carried = CarriedBy(model, then, other);
  double most_px = 0;
  for (int y = 0; y < lens.height_px; y += kProbe_px) {
    for (int x = 0; x < lens.width_px; x += kProbe_px) {
      const std::optional<Vec3> ray_C = lens.RayOf(Vec2(x, y));
      if (!ray_C) continue;
      const double depth_m = frame.depth_m.at(x, y);
      for (const Pose& X_DC : carried[frame.instance.at(x, y)]) {
        const Vec3 p_D = depth_m > 0 ? X_DC * (depth_m * *ray_C) : X_DC.linear() * *ray_C;
        if (!lens.Sees(p_D)) continue;
        most_px = std::max(most_px, (lens.Project(p_D) - Vec2(x, y)).norm());
      }
    }
  }
  return most_px;
}

}  // namespace tera
