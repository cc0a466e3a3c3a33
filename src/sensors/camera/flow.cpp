#include "sensors/camera/flow.h"

#include <algorithm>
#include <cmath>

#include "core/types/image_flow.h"
#include "render/gl/body_picture.h"

namespace tera {
namespace {

constexpr double kHalfPixel_px = 0.5;
constexpr double kSameDepth = 0.01;  // relative tolerance for the variation of depth between pixels

/// Transforms from C to the other camera frame: first for static points, then for each body.
std::vector<Pose> CarriedBy(const SeenSurfaces& from, const SeenSurfaces& to) {
  const Pose X_DW = to.X_WC.inverse();
  std::vector<Pose> carried = {X_DW * from.X_WC};
  for (std::size_t b = 0; b < from.X_WB.size(); ++b) {
    carried.push_back(X_DW * to.X_WB[b] * from.X_WB[b].inverse() * from.X_WC);
  }
  return carried;
}

bool IsOnPixels(const CameraIntrinsics& lens, const Vec2& pixel_px) {
  return pixel_px.x() >= -kHalfPixel_px && pixel_px.y() >= -kHalfPixel_px &&
         pixel_px.x() < lens.width_px - kHalfPixel_px &&
         pixel_px.y() < lens.height_px - kHalfPixel_px;
}

/// True if an image shows the point of a body at that position and depth (0 for infinity).
bool Shows(const SeenSurfaces& seen, std::uint16_t body, const Vec2& pixel_px, double depth_m) {
  const int left = static_cast<int>(std::floor(pixel_px.x()));
  const int top = static_cast<int>(std::floor(pixel_px.y()));
  for (int y = std::max(top, 0); y <= std::min(top + 1, seen.body.height_px - 1); ++y) {
    for (int x = std::max(left, 0); x <= std::min(left + 1, seen.body.width_px - 1); ++x) {
      if (seen.body.at(x, y) != body) continue;
      const double there_m = seen.depth_m.at(x, y);
      if (there_m == 0 || (depth_m > 0 && depth_m <= (1 + kSameDepth) * there_m)) return true;
    }
  }
  return false;
}

void Put(const std::array<std::uint16_t, 3>& pixel, int x_px, int y_px,
         Image<std::uint16_t>* picture) {
  for (int k = 0; k < 3; ++k) picture->at(x_px, y_px, k) = pixel[static_cast<std::size_t>(k)];
}

}  // namespace

void FlowBetween(const PixelRays& rays, const SeenSurfaces& from, const SeenSurfaces& to,
                 Image<std::uint16_t>* flow, Image<std::uint16_t>* scene_flow) {
  const CameraIntrinsics& lens = rays.lens();
  const std::vector<Pose> X_DC = CarriedBy(from, to);
  for (int y = 0; y < lens.height_px; ++y) {
    for (int x = 0; x < lens.width_px; ++x) {
      const Vec3& ray_C = rays.at(x, y);
      const std::uint16_t body = from.body.at(x, y);
      if (ray_C.isZero() || body == kSoilInFlight) continue;
      const double depth_m = from.depth_m.at(x, y);
      const Vec3 p_C_m = depth_m * ray_C;
      const Vec3 p_D_m = depth_m > 0 ? X_DC[body] * p_C_m : X_DC[body].linear() * ray_C;
      if (scene_flow != nullptr && depth_m > 0) {
        Put(PixelOfShift(p_D_m - p_C_m), x, y, scene_flow);
      }
      if (flow == nullptr || !lens.Sees(p_D_m)) continue;
      const Vec2 pixel_px = lens.Project(p_D_m);
      const double there_m = depth_m > 0 ? lens.DepthOf(p_D_m) : 0;
      const FlowState state = !IsOnPixels(lens, pixel_px)          ? FlowState::kOutside
                              : Shows(to, body, pixel_px, there_m) ? FlowState::kSeen
                                                                   : FlowState::kHidden;
      Put(PixelOfFlow(pixel_px - Vec2(x, y), state), x, y, flow);
    }
  }
}

}  // namespace tera
