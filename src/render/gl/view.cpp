#include "render/gl/view.h"

namespace tera {

View::View(const CameraIntrinsics& pinhole, const Pose& X_WC)
    : eye_W_m(X_WC.translation()),
      R_WC(X_WC.linear()),
      width_px(pinhole.width_px),
      height_px(pinhole.height_px),
      fx_px(pinhole.fx_px),
      fy_px(pinhole.fy_px),
      cx_px(pinhole.cx_px),
      cy_px(pinhole.cy_px),
      near_m(pinhole.near_m) {
  // Distances of the image's left and top edge from the principal point.
  const double left = cx_px + 0.5, top = cy_px + 0.5;
  const double right = width_px - left, bottom = height_px - top;
  const std::array<Vec3, 5> normals_C = {Vec3(fx_px, 0, left), Vec3(-fx_px, 0, right),
                                         Vec3(0, fy_px, top), Vec3(0, -fy_px, bottom),
                                         Vec3(0, 0, 1)};
  for (std::size_t i = 0; i < planes_.size(); ++i) {
    const Vec3 normal_W = R_WC * normals_C[i].normalized();
    const double distance_m = i + 1 == planes_.size() ? near_m : 0.0;
    planes_[i] = {normal_W, -normal_W.dot(eye_W_m) - distance_m};
  }
}

Eigen::Matrix4f View::ClipFromRelative() const {
  Eigen::Matrix4d clip_C = Eigen::Matrix4d::Zero();
  clip_C.row(0) << 2 * fx_px / width_px, 0, 2 * (cx_px + 0.5) / width_px - 1, 0;
  clip_C.row(1) << 0, 2 * fy_px / height_px, 2 * (cy_px + 0.5) / height_px - 1, 0;
  clip_C(2, 3) = near_m;
  clip_C(3, 2) = 1;
  Eigen::Matrix4d X_CR = Eigen::Matrix4d::Identity();
  X_CR.topLeftCorner<3, 3>() = R_WC.transpose();
  return (clip_C * X_CR).cast<float>();
}

bool View::IsSame(const View& other) const {
  return eye_W_m == other.eye_W_m && R_WC == other.R_WC && width_px == other.width_px &&
         height_px == other.height_px && fx_px == other.fx_px && fy_px == other.fy_px &&
         cx_px == other.cx_px && cy_px == other.cy_px && near_m == other.near_m;
}

bool View::Sees(const Vec3& box_min_W_m, const Vec3& box_max_W_m) const {
  for (const Plane& plane : planes_) {
    Vec3 farthest;  // corner of the box farthest along the normal
    for (int k = 0; k < 3; ++k) {
      farthest[k] = plane.normal_W[k] > 0 ? box_max_W_m[k] : box_min_W_m[k];
    }
    if (plane.normal_W.dot(farthest) + plane.offset_m < 0) return false;
  }
  return true;
}

bool View::SeesSphere(const Vec3& centre_W_m, double radius_m) const {
  for (const Plane& plane : planes_) {
    if (plane.normal_W.dot(centre_W_m) + plane.offset_m < -radius_m) return false;
  }
  return true;
}

}  // namespace tera
