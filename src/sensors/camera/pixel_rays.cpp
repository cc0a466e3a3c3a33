#include "sensors/camera/pixel_rays.h"

namespace tera {

PixelRays::PixelRays(const CameraIntrinsics& lens) : lens_(lens) {
  rays_C_.reserve(static_cast<std::size_t>(lens.width_px) * lens.height_px);
  for (int y = 0; y < lens.height_px; ++y) {
    for (int x = 0; x < lens.width_px; ++x) {
      rays_C_.push_back(lens.RayOf(Vec2(x, y)).value_or(Vec3::Zero()));
    }
  }
}

}  // namespace tera
