#include "render/gl/amodal_boxes.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tera {
namespace {

constexpr double kHalf_px = 0.5;

/// Projects points that a picture may not hold.
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

  /// Of a point with z > 0, or of an angular lens's field.
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

/// What an object covers, with the pixels that hold it whole: from their outer borders.
class Extent {
 public:
  explicit Extent(const CameraIntrinsics& lens) : lens_(lens), project_(lens) {}

  void AddTriangle(const std::array<Vec3, 3>& p_C_m) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3& a = p_C_m[k];
      if (lens_.IsAngular() ? lens_.Sees(a) : a.z() >= lens_.near_m) box_px_.extend(project_(a));
      const Vec3& b = p_C_m[(k + 1) % 3];
      if (!lens_.IsAngular() && (a.z() < lens_.near_m) != (b.z() < lens_.near_m)) {
        const double s = (lens_.near_m - a.z()) / (b.z() - a.z());
        box_px_.extend(project_(a + s * (b - a)));
      }
    }
  }
  /// The pixels that show it.
  void AddPixels(const ObjectBox& seen) {
    box_px_.extend(Vec2(seen.x_min_px, seen.y_min_px));
    box_px_.extend(Vec2(seen.x_max_px, seen.y_max_px));
  }
  const Eigen::AlignedBox2d& box_px() const { return box_px_; }
  /// The share of the box that lies beyond the picture.
  double Truncation() const {
    const Eigen::AlignedBox2d picture(Vec2(-kHalf_px, -kHalf_px),
                                      Vec2(lens_.width_px - kHalf_px, lens_.height_px - kHalf_px));
    const double area = box_px_.isEmpty() ? 0 : box_px_.volume();
    if (!(area > 0)) return 0;
    const Eigen::AlignedBox2d within = box_px_.intersection(picture);
    return 1 - (within.isEmpty() ? 0 : within.volume()) / area;
  }

 private:
  const CameraIntrinsics& lens_;
  WideProjection project_;
  Eigen::AlignedBox2d box_px_;
};

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
    for (std::size_t k = 0; k + 2 < part.indices.size(); k += 3) {
      extent->AddTriangle(
          {p_C_m[part.indices[k]], p_C_m[part.indices[k + 1]], p_C_m[part.indices[k + 2]]});
    }
  }
}

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
                     const Pose& X_WC, const CameraFrame& frame, std::vector<ObjectBox>* boxes) {
  const Pose X_CW = X_WC.inverse();
  for (ObjectBox& box : *boxes) {
    Extent extent(lens);
    for (const SceneNode& node : model.nodes) {
      if (Belongs(model, node.instance, box.instance)) AddNode(model, node, state, X_CW, &extent);
    }
    // A field's rim may cut an object where it has no corner.
    extent.AddPixels(box);
    if (!extent.box_px().isEmpty()) {
      box.amodal_min_px = extent.box_px().min();
      box.amodal_max_px = extent.box_px().max();
    }
    box.truncation = extent.Truncation();
    AddKeypoints(model, state, lens, X_CW, frame, &box);
  }
}

}  // namespace tera
