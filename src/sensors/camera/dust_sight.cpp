#include "sensors/camera/dust_sight.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "render/air/dust_volume.h"

namespace tera {

Image<float> DustOpticalDepths(const PixelRays& rays, const SeenScene& scene,
                               const Image<float>& depth_m) {
  Image<float> depths(depth_m.width_px, depth_m.height_px);
  if (scene.state.dust == nullptr) return depths;
  for (int y = 0; y < depth_m.height_px; ++y) {
    for (int x = 0; x < depth_m.width_px; ++x) {
      const Vec3& ray_C = rays.at(x, y);
      const double length = ray_C.norm();
      if (!(length > 0)) continue;
      const double z_m = depth_m.at(x, y);
      const double range_m = z_m > 0 ? z_m * length : std::numeric_limits<double>::infinity();
      depths.at(x, y) =
          static_cast<float>(OpticalDepth(*scene.state.dust, scene.X_WC.translation(),
                                          scene.X_WC.linear() * (ray_C / length), range_m));
    }
  }
  return depths;
}

Image<std::uint16_t> DustLabel(const Image<float>& optical_depth) {
  Image<std::uint16_t> label(optical_depth.width_px, optical_depth.height_px);
  for (std::size_t i = 0; i < label.data.size(); ++i) {
    label.data[i] = PixelOfOpticalDepth(optical_depth.data[i]);
  }
  return label;
}

Image<float> AirOpticalDepths(const PixelRays& rays, double extinction_1pm, Image<float> dust,
                              const Image<float>& depth_m) {
  if (dust.empty()) dust = Image<float>(depth_m.width_px, depth_m.height_px);
  for (int y = 0; y < depth_m.height_px; ++y) {
    for (int x = 0; x < depth_m.width_px; ++x) {
      const double range_m = double(depth_m.at(x, y)) * rays.at(x, y).norm();
      dust.at(x, y) += static_cast<float>(extinction_1pm * std::max(range_m, 0.0));
    }
  }
  return dust;
}

void LoseDepthInAir(const Image<float>& optical_depth, Image<float>* depth_m) {
  static const auto most = static_cast<float>(-std::log(kLeastContrast));
  for (std::size_t i = 0; i < depth_m->data.size(); ++i) {
    if (optical_depth.data[i] > most) depth_m->data[i] = 0;
  }
}

}  // namespace tera
