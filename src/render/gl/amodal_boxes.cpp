#include "render/gl/amodal_boxes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace tera {
namespace {

constexpr double kHalf_px = 0.5;

/// Projects points inside and outside the image. Outside, it continues a distorting lens as a
/// pinhole.
class WideProjection {
 public:
  explicit WideProjection(const CameraIntrinsics& lens) : lens_(lens) {
    if (lens.IsAngular() || !lens.Distorted()) return;
    for (const double x : {-kHalf_px, lens.width_px - kHalf_px}) {
      for (const double y : {-kHalf_px, lens.height_px - kHalf_px}) {
        const auto ray_C = lens.RayOf({x, y});
        if (ray_C) widest_ = std::max(widest_, (ray_C->head<2>() / ray_C->z()).norm());
      }
    }
  }

  /// Pixel of a point. Needs z > 0, or a point within an angular lens's field.
  Vec2 operator()(const Vec3& p_C_m) const {
    if (lens_.IsAngular() || !lens_.Distorted()) return lens_.Project(p_C_m);
    const Vec2 at = p_C_m.head<2>() / p_C_m.z();
    if (at.norm() <= widest_) return lens_.Project(p_C_m);
    const Vec2 rim = at * (widest_ / at.norm());
    return lens_.Project({rim.x(), rim.y(), 1}) +
           Vec2(lens_.fx_px, lens_.fy_px).cwiseProduct(at - rim);
  }

 private:
  const CameraIntrinsics& lens_;
  double widest_ = 0;
};

/// Bounding box of projected surfaces on the unbounded image plane.
class Extent {
 public:
  explicit Extent(const CameraIntrinsics& lens) : lens_(lens), project_(lens) {}

  /// Adds each corner in front of the camera, and the intersections of edges with the near plane.
  void AddTriangles(const std::vector<Vec3>& p_C_m, const std::vector<std::uint32_t>& indices) {
    const std::size_t used = indices.size() / 3 * 3;
    is_corner_.assign(p_C_m.size(), false);
    for (std::size_t k = 0; k < used; ++k) is_corner_[indices[k]] = true;
    std::size_t corners = 0, seen = 0;
    for (std::size_t i = 0; i < p_C_m.size(); ++i) {
      if (!is_corner_[i]) continue;
      ++corners;
      if (!IsBefore(p_C_m[i])) continue;
      ++seen;
      box_px_.extend(project_(p_C_m[i]));
    }
    if (lens_.IsAngular() || seen == 0 || seen == corners) return;
    for (std::size_t k = 0; k < used; ++k) {
      const Vec3& a = p_C_m[indices[k]];
      const Vec3& b = p_C_m[indices[k % 3 == 2 ? k - 2 : k + 1]];
      if (IsBefore(a) == IsBefore(b)) continue;
      const double s = (lens_.near_m - a.z()) / (b.z() - a.z());
      box_px_.extend(project_(a + s * (b - a)));
    }
  }
  const Eigen::AlignedBox2d& box_px() const { return box_px_; }

 private:
  bool IsBefore(const Vec3& p_C_m) const {
    return lens_.IsAngular() ? lens_.Sees(p_C_m) : p_C_m.z() >= lens_.near_m;
  }

  const CameraIntrinsics& lens_;
  WideProjection project_;
  std::vector<bool> is_corner_;
  Eigen::AlignedBox2d box_px_;
};

/// Fraction of a box outside the image.
double Truncation(const Eigen::AlignedBox2d& box_px, const CameraIntrinsics& lens) {
  const Eigen::AlignedBox2d picture(Vec2(-kHalf_px, -kHalf_px),
                                    Vec2(lens.width_px - kHalf_px, lens.height_px - kHalf_px));
  const double area = box_px.isEmpty() ? 0 : box_px.volume();
  if (!(area > 0)) return 0;
  const Eigen::AlignedBox2d within = box_px.intersection(picture);
  return 1 - (within.isEmpty() ? 0 : within.volume()) / area;
}

bool Belongs(const SceneModel& model, std::uint16_t instance, std::uint16_t object) {
  return instance == object || (instance != 0 && model.instances[instance].parent == object);
}

void AddNode(const SceneModel& model, const SceneNode& node, const SceneState& state,
             const Pose& X_CW, Extent* extent) {
  const ShapedMesh* shape = node.shape >= 0 ? ShapeAt(state.shapes, node.shape) : nullptr;
  if (node.shape >= 0 && shape == nullptr) return;
  Eigen::Affine3d X_CG(X_CW * state.X_WB[node.body] * node.X_BG);
  X_CG.scale(node.scale);
  std::vector<Vec3> p_C_m;
  for (const MeshPart& part : shape ? shape->parts : model.meshes[node.mesh].parts) {
    p_C_m.clear();
    for (const Eigen::Vector3f& p : part.positions_m) p_C_m.push_back(X_CG * p.cast<double>());
    extent->AddTriangles(p_C_m, part.indices);
  }
}

/// Extents of the nodes' instances. Only instances with a box, or parts of a whole with a box, are
/// computed.
class Extents {
 public:
  Extents(const SceneModel& model, const SceneState& state, const CameraIntrinsics& lens,
          const Pose& X_CW, const std::vector<ObjectBox>& boxes, Workers* workers)
      : model_(model), own_(model.instances.size()) {
    std::vector<const SceneNode*> nodes;
    for (const SceneNode& node : model.nodes) {
      const auto is_of = [&](const ObjectBox& box) {
        return Belongs(model, node.instance, box.instance);
      };
      if (std::any_of(boxes.begin(), boxes.end(), is_of)) nodes.push_back(&node);
    }
    std::vector<Eigen::AlignedBox2d> of_node(nodes.size());
    workers->ForRanges(nodes.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t n = begin; n < end; ++n) {
        Extent extent(lens);
        AddNode(model, *nodes[n], state, X_CW, &extent);
        of_node[n] = extent.box_px();
      }
    });
    for (std::size_t n = 0; n < nodes.size(); ++n) own_[nodes[n]->instance].extend(of_node[n]);
  }

  /// Extent of an instance, or of a whole with its parts.
  Eigen::AlignedBox2d Of(std::uint16_t object) const {
    Eigen::AlignedBox2d box_px;
    for (std::size_t i = 0; i < own_.size(); ++i) {
      if (Belongs(model_, static_cast<std::uint16_t>(i), object)) box_px.extend(own_[i]);
    }
    return box_px;
  }

 private:
  const SceneModel& model_;
  std::vector<Eigen::AlignedBox2d> own_;
};

KeypointSight SightOf(const SceneModel& model, const SceneKeypoint& keypoint,
                      const CameraIntrinsics& lens, const Vec3& p_C_m, const Vec2& pixel_px,
                      const CameraFrame& frame) {
  const int x = static_cast<int>(std::lround(pixel_px.x()));
  const int y = static_cast<int>(std::lround(pixel_px.y()));
  if (x < 0 || y < 0 || x >= lens.width_px || y >= lens.height_px) return KeypointSight::kOutside;
  const double seen_m = frame.depth_m.at(x, y);
  const bool is_own = Belongs(model, frame.instance.at(x, y), keypoint.instance);
  return is_own && seen_m > 0 && lens.DepthOf(p_C_m) - seen_m <= keypoint.radius_m
             ? KeypointSight::kSeen
             : KeypointSight::kHidden;
}

void AddKeypoints(const SceneModel& model, const SceneState& state, const CameraIntrinsics& lens,
                  const Pose& X_CW, const CameraFrame& frame, ObjectBox* box) {
  const WideProjection project(lens);
  for (const SceneKeypoint& keypoint : model.keypoints) {
    if (keypoint.instance != box->instance) continue;
    Keypoint seen;
    seen.name = keypoint.name;
    seen.p_C_m = X_CW * state.X_WB[keypoint.body] * keypoint.p_B_m;
    if (lens.IsAngular() ? lens.Sees(seen.p_C_m) : seen.p_C_m.z() >= lens.near_m) {
      seen.pixel_px = project(seen.p_C_m);
      seen.sight = SightOf(model, keypoint, lens, seen.p_C_m, *seen.pixel_px, frame);
    }
    box->keypoints.push_back(seen);
  }
}

}  // namespace

void AddWholeObjects(const SceneModel& model, const SceneState& state, const CameraIntrinsics& lens,
                     const Pose& X_WC, const CameraFrame& frame, Workers* workers,
                     std::vector<ObjectBox>* boxes) {
  const Pose X_CW = X_WC.inverse();
  const Extents extents(model, state, lens, X_CW, *boxes, workers);
  for (ObjectBox& box : *boxes) {
    Eigen::AlignedBox2d extent_px = extents.Of(box.instance);
    // The rim of an angular lens's field may cut an object between two of its corners.
    extent_px.extend(Vec2(box.x_min_px, box.y_min_px));
    extent_px.extend(Vec2(box.x_max_px, box.y_max_px));
    box.amodal_min_px = extent_px.min();
    box.amodal_max_px = extent_px.max();
    box.truncation = Truncation(extent_px, lens);
    AddKeypoints(model, state, lens, X_CW, frame, &box);
  }
}

}  // namespace tera
