#include "render/gl/object_boxes.h"

#include <algorithm>
#include <mutex>

#include "core/check.h"

namespace tera {

std::vector<std::int64_t> CountPixels(const Image<std::uint16_t>& instance,
                                      const SceneModel& model) {
  std::vector<std::int64_t> counts(model.instances.size(), 0);
  for (const std::uint16_t i : instance.data) {
    TERA_CHECK(i < counts.size(), i, counts.size());
    ++counts[i];
    if (model.instances[i].parent != 0) ++counts[model.instances[i].parent];
  }
  return counts;
}

namespace {

/// Extends the box and the count of a whole by those of its part.
void AddPixels(const ObjectBox& part, ObjectBox* whole) {
  whole->x_min_px = std::min(whole->x_min_px, part.x_min_px);
  whole->y_min_px = std::min(whole->y_min_px, part.y_min_px);
  whole->x_max_px = std::max(whole->x_max_px, part.x_max_px);
  whole->y_max_px = std::max(whole->y_max_px, part.y_max_px);
  whole->visible_px += part.visible_px;
}

void AddRow(const Image<std::uint16_t>& instance, int y, std::vector<ObjectBox>* boxes) {
  for (int x = 0; x < instance.width_px; ++x) {
    const std::uint16_t i = instance.at(x, y);
    if (i == 0) continue;
    ObjectBox& box = (*boxes)[i];
    box.x_min_px = std::min(box.x_min_px, x);
    box.x_max_px = std::max(box.x_max_px, x);
    box.y_min_px = std::min(box.y_min_px, y);
    box.y_max_px = std::max(box.y_max_px, y);
    ++box.visible_px;
  }
}

/// Box of all present nodes of an object, or of all parts of a whole, along the axes of its body.
Eigen::AlignedBox3d BoxOfNodes(const SceneModel& model, const SceneState& state,
                               std::uint16_t object) {
  const Pose X_BW = state.X_WB[model.instances[object].body].inverse();
  Eigen::AlignedBox3f box;
  for (const SceneNode& node : model.nodes) {
    const bool belongs = node.instance == object || model.instances[node.instance].parent == object;
    if (node.shape >= 0 || !belongs) continue;
    const Pose X_BN = X_BW * state.X_WB[node.body] * node.X_BG;
    Eigen::Affine3f X_BG(X_BN.matrix().cast<float>());
    X_BG.scale(static_cast<float>(node.scale));
    for (const MeshPart& part : model.meshes[node.mesh].parts) {
      for (const Eigen::Vector3f& p_m : part.positions_m) box.extend(X_BG * p_m);
    }
  }
  return {box.min().cast<double>(), box.max().cast<double>()};
}

/// True if some nodes of the object move with another body: cylinders of a link, shoes of a track.
bool MovesInItself(const SceneModel& model, std::uint16_t i) {
  return std::any_of(model.nodes.begin(), model.nodes.end(), [&](const SceneNode& node) {
    return node.instance == i && node.body != model.instances[i].body;
  });
}

/// The box of an object in the frame of its body.
Eigen::AlignedBox3d BoxOf(const SceneModel& model, const SceneState& state, std::uint16_t i) {
  const SceneInstance& object = model.instances[i];
  if (object.is_whole || MovesInItself(model, i)) return BoxOfNodes(model, state, i);
  if (const ShapedMesh* shape = ShapeAt(state.shapes, object.shape)) {
    return {shape->box_min_B_m, shape->box_max_B_m};
  }
  return {object.box_min_B_m, object.box_max_B_m};
}

/// Pixel count and pixel box of each instance; an inverted box if it has no pixels.
std::vector<ObjectBox> BoxesOfPixels(const Image<std::uint16_t>& instance, std::size_t instances,
                                     Workers* workers) {
  constexpr std::size_t kLeastRows = 32;
  ObjectBox none;
  none.x_min_px = instance.width_px;
  none.y_min_px = instance.height_px;
  std::vector<ObjectBox> all(instances, none);
  std::mutex mutex;
  workers->ForRanges(static_cast<std::size_t>(instance.height_px), kLeastRows,
                     [&](std::size_t begin, std::size_t end) {
                       std::vector<ObjectBox> own(instances, none);
                       for (std::size_t y = begin; y < end; ++y) {
                         AddRow(instance, static_cast<int>(y), &own);
                       }
                       const std::lock_guard lock(mutex);
                       for (std::size_t i = 1; i < instances; ++i) AddPixels(own[i], &all[i]);
                     });
  return all;
}

}  // namespace

std::vector<ObjectBox> FindBoxes(const SceneModel& model, const SceneState& state, const Pose& X_WC,
                                 const Image<std::uint16_t>& instance, Workers* workers) {
  std::vector<ObjectBox> all = BoxesOfPixels(instance, model.instances.size(), workers);
  for (std::size_t i = 1; i < all.size(); ++i) {
    const std::uint16_t whole = model.instances[i].parent;
    if (whole != 0 && all[i].visible_px > 0) AddPixels(all[i], &all[whole]);
  }
  std::vector<ObjectBox> visible;
  for (std::size_t i = 1; i < all.size(); ++i) {
    if (all[i].visible_px == 0) continue;
    const SceneInstance& object = model.instances[i];
    ObjectBox box = all[i];
    box.instance = static_cast<std::uint16_t>(i);
    box.parent = object.parent;
    box.label = object.label;
    box.name = object.name;
    if (object.body >= 0) {
      const Eigen::AlignedBox3d at_B_m = BoxOf(model, state, box.instance);
      box.X_CO = X_WC.inverse() * state.X_WB[object.body] * MakePose(at_B_m.center());
      box.size_O_m = at_B_m.sizes();
    }
    visible.push_back(std::move(box));
  }
  return visible;
}

}  // namespace tera
