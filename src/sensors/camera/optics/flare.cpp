#include "sensors/camera/optics/flare.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"

namespace tera {

Flare::Flare(const FlareModel& model, const CameraIntrinsics& camera, const Stream& draw)
    : model_(model), camera_(camera) {
  for (int k = 0; k < model.ghosts; ++k) {
    const auto index = static_cast<std::uint64_t>(k);
    const auto number = [&](std::uint32_t which) { return draw.Uniform(index, which); };
    const double side = number(0) < 0.75 ? -1 : 0.6;  // most ghosts lie opposite the source
    const Vec3 tint = Vec3(0.3 + number(3), 0.3 + number(4), 0.3 + number(5));
    ghosts_.push_back({.place = side * (0.15 + 1.1 * number(1)),
                       .radius = 0.015 * std::exp2(3 * number(2)),
                       .tint = 3 * tint / tint.sum()});
  }
}

void Flare::Apply(const Vec2& source_px, const Vec3& illuminance_lx, Image<float>* picture) const {
  const Vec2 centre_px(camera_.cx_px, camera_.cy_px);
  for (const Ghost& ghost : ghosts_) {
    const Vec2 middle_px = centre_px + ghost.place * (source_px - centre_px);
    const double radius_px = ghost.radius * camera_.fx_px;
    const double soft_px = std::max(0.12 * radius_px, 1.0);
    // A linear symmetric rim preserves the integral up to soft^2 / 12.
    const double area_px = kPi * (radius_px * radius_px + soft_px * soft_px / 12);
    const double solid_angle_sr = area_px / (camera_.fx_px * camera_.fy_px);
    const Vec3 light_cdpm2 = model_.reflectance * model_.reflectance / solid_angle_sr *
                             illuminance_lx.cwiseProduct(ghost.tint);
    const int reach = static_cast<int>(radius_px + soft_px) + 1;
    const int x0 = static_cast<int>(std::lround(middle_px.x()));
    const int y0 = static_cast<int>(std::lround(middle_px.y()));
    for (int y = std::max(y0 - reach, 0); y <= std::min(y0 + reach, picture->height_px - 1); ++y) {
      for (int x = std::max(x0 - reach, 0); x <= std::min(x0 + reach, picture->width_px - 1); ++x) {
        const double from_px = (Vec2(x, y) - middle_px).norm();
        const double cover = std::clamp(0.5 + (radius_px - from_px) / soft_px, 0.0, 1.0);
        for (int c = 0; c < 3; ++c) {
          picture->at(x, y, c) += static_cast<float>(cover * light_cdpm2[c]);
        }
      }
    }
  }
}

}  // namespace tera
