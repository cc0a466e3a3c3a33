#include "sensors/camera/object_light.h"

#include <algorithm>
#include <vector>

#include "render/gl/body_picture.h"

namespace tera {
namespace {

/// Sums over the pixels of an object, and their number.
struct Sums {
  ObjectLight light;
  std::int64_t pixels = 0;

  void Add(const ObjectLight& other, std::int64_t count) {
    light.blur_px += other.blur_px;
    light.most_blur_px = std::max(light.most_blur_px, other.most_blur_px);
    light.luminance_cdpm2 += other.luminance_cdpm2;
    light.illuminance_lx += other.illuminance_lx;
    light.shadow += other.shadow;
    pixels += count;
  }
  ObjectLight Mean() const {
    const auto n = static_cast<double>(pixels);
    return {light.blur_px / n, light.most_blur_px, light.luminance_cdpm2 / n,
            light.illuminance_lx / n, light.shadow / n};
  }
};

/// Image motion during the exposure: transforms from C at the stamp to C at opening and at closing.
/// The first entry is for static points, the others for the bodies.
class OpenShutter {
 public:
  OpenShutter(const CameraIntrinsics& lens, const SceneAt& scene_at, TimeNs t_ns, double open_s)
      : lens_(lens), moves_(open_s > 0) {
    if (!moves_) return;
    const SeenScene middle = scene_at(t_ns);
    const TimeNs half_ns = FromSeconds(0.5 * open_s);
    X_OC_ = CarriedTo(middle, scene_at(t_ns - half_ns));
    X_SC_ = CarriedTo(middle, scene_at(t_ns + half_ns));
  }

  double Way_px(std::uint16_t body, const Vec3& ray_C, double depth_m) const {
    if (!moves_ || body >= X_OC_.size()) return 0;
    const auto at = [&](const Pose& X_DC) {
      return Vec3(depth_m > 0 ? X_DC * (depth_m * ray_C) : X_DC.linear() * ray_C);
    };
    const Vec3 p_O_m = at(X_OC_[body]), p_S_m = at(X_SC_[body]);
    if (!lens_.Sees(p_O_m) || !lens_.Sees(p_S_m)) return 0;
    return (lens_.Project(p_S_m) - lens_.Project(p_O_m)).norm();
  }

 private:
  static std::vector<Pose> CarriedTo(const SeenScene& from, const SeenScene& to) {
    const Pose X_DW = to.X_WC.inverse();
    std::vector<Pose> carried = {X_DW * from.X_WC};
    for (std::size_t b = 0; b < from.state.X_WB.size(); ++b) {
      carried.push_back(X_DW * to.state.X_WB[b] * from.state.X_WB[b].inverse() * from.X_WC);
    }
    return carried;
  }

  const CameraIntrinsics& lens_;
  bool moves_;
  std::vector<Pose> X_OC_, X_SC_;  ///< at opening and at closing
};

}  // namespace

void FillObjectLight(const PixelRays& rays, const LitPicture& picture, const SceneAt& scene_at,
                     TimeNs t_ns, double open_s, CameraFrame* frame) {
  const OpenShutter shutter(rays.lens(), scene_at, t_ns, open_s);
  std::vector<Sums> sums(picture.model.instances.size());
  for (int y = 0; y < rays.lens().height_px; ++y) {
    for (int x = 0; x < rays.lens().width_px; ++x) {
      const std::uint16_t instance = frame->instance.at(x, y);
      if (instance == 0) continue;
      const Image<float>& rgb = picture.luminance_cdpm2;
      ObjectLight light;
      light.blur_px =
          shutter.Way_px(picture.body.at(x, y), rays.at(x, y), picture.depth_m.at(x, y));
      light.most_blur_px = light.blur_px;
      light.luminance_cdpm2 =
          0.2126 * rgb.at(x, y, 0) + 0.7152 * rgb.at(x, y, 1) + 0.0722 * rgb.at(x, y, 2);
      light.illuminance_lx = picture.illuminance_lx_share.at(x, y, 0);
      light.shadow = 1 - picture.illuminance_lx_share.at(x, y, 1);
      sums[instance].Add(light, 1);
    }
  }
  for (std::size_t i = 1; i < sums.size(); ++i) {
    const std::uint16_t whole = picture.model.instances[i].parent;
    if (whole != 0 && sums[i].pixels > 0) sums[whole].Add(sums[i].light, sums[i].pixels);
  }
  for (ObjectBox& box : frame->boxes) {
    if (sums[box.instance].pixels > 0) box.light = sums[box.instance].Mean();
  }
}

}  // namespace tera
