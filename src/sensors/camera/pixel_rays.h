#pragma once

#include <vector>

#include "render/gl/camera_intrinsics.h"

namespace tera {

/// Rays of all pixels of a lens, computed once.
class PixelRays {
 public:
  explicit PixelRays(const CameraIntrinsics& lens);

  const CameraIntrinsics& lens() const { return lens_; }
  /// Point of depth 1 in C on the ray of a pixel (CameraIntrinsics::Unproject); zero for a pixel
  /// without a ray.
  const Vec3& at(int x_px, int y_px) const {
    return rays_C_[static_cast<std::size_t>(y_px) * lens_.width_px + x_px];
  }

 private:
  CameraIntrinsics lens_;
  std::vector<Vec3> rays_C_;
};

}  // namespace tera
