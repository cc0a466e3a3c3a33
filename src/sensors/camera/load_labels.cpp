#include "sensors/camera/load_labels.h"

#include <algorithm>

namespace tera {

void LoadLabels::Fill(const SceneModel& model, const SceneState& state, CameraFrame* frame) {
  std::vector<double> now_kg;
  frame->loads.clear();
  for (std::size_t i = 1; i < model.instances.size(); ++i) {
    const SceneInstance& instance = model.instances[i];
    if (instance.shape < 0) continue;
    CarriedLoad load;
    load.instance = static_cast<std::uint16_t>(i);
    load.name = instance.name;
    load.visible_px = std::ranges::count(frame->instance.data, load.instance);
    if (const ShapedMesh* soil = ShapeAt(state.shapes, instance.shape)) {
      load.volume_m3 = soil->volume_m3;
      load.mass_kg = soil->mass_kg;
    }
    if (instance.capacity_m3 > 0) load.fill = load.volume_m3 / instance.capacity_m3;
    if (!before_kg_.empty() && state.t_ns > before_ns_) {
      load.released_kgps =
          (before_kg_[now_kg.size()] - load.mass_kg) / ToSeconds(state.t_ns - before_ns_);
    }
    now_kg.push_back(load.mass_kg);
    frame->loads.push_back(std::move(load));
  }
  before_kg_ = std::move(now_kg);
  before_ns_ = state.t_ns;
}

}  // namespace tera
