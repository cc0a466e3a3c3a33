#include "sensors/camera/ranging/stereo.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <opencv2/calib3d.hpp>

namespace tera {
namespace {

constexpr double kDarkest_cdpm2 = 0.5;  // least mean luminance for full exposure
constexpr double kSteps = 16;           // disparity steps per pixel of OpenCV's matcher

/// The image of an eye under scene light, with inputs for the projector.
struct Seen {
  Image<float> luminance_cdpm2, depth_m, light;
};

Seen SeenFrom(const CameraIntrinsics& camera, const Pose& X_WE, const SceneState& state,
              bool needs_light, Rasterizer* rasterizer) {
  LuminancePicture luminance{.white_cdpm2 = MeteredWhite_cdpm2(*rasterizer), .cdpm2 = {}};
  Seen seen;
  CameraFrame frame = rasterizer->Render(camera, X_WE, state, {}, &luminance, nullptr,
                                         needs_light ? &seen.light : nullptr);
  seen.depth_m = std::move(frame.depth_m);
  seen.luminance_cdpm2 = Image<float>(camera.width_px, camera.height_px);
  for (std::size_t i = 0; i < seen.luminance_cdpm2.data.size(); ++i) {
    const float* rgb = &luminance.cdpm2.data[3 * i];
    seen.luminance_cdpm2.data[i] = 0.2126f * rgb[0] + 0.7152f * rgb[1] + 0.0722f * rgb[2];
  }
  return seen;
}

Image<std::uint8_t> Grey(const Image<float>& luminance_cdpm2, double per_cdpm2, double noise_dn,
                         const Stream& noise, std::uint64_t first) {
  Image<std::uint8_t> grey(luminance_cdpm2.width_px, luminance_cdpm2.height_px);
  for (std::size_t i = 0; i < grey.data.size(); ++i) {
    const double dn = per_cdpm2 * double(luminance_cdpm2.data[i]) +
                      (noise_dn > 0 ? noise_dn * noise.Gaussian(first + i) : 0);
    grey.data[i] = static_cast<std::uint8_t>(std::clamp(std::round(dn), 0.0, 255.0));
  }
  return grey;
}

cv::Mat View(const Image<std::uint8_t>& picture) {
  return {picture.height_px, picture.width_px, CV_8UC1,
          const_cast<std::uint8_t*>(picture.data.data())};
}

}  // namespace

void Serialize(ModelArchive* archive, StereoModel* m) {
  archive->Visit("disparities_px", &m->disparities_px, Between(16, 1024, "px"));
  archive->Check(m->disparities_px % 16 == 0, "disparities_px",
                 {FaultKind::kOutOfRange,
                  fmt::format("{} is no multiple of 16; need {} or {}", m->disparities_px,
                              m->disparities_px / 16 * 16, m->disparities_px / 16 * 16 + 16)});
  archive->Visit("block_px", &m->block_px, Between(1, 11, "px"));
  archive->Check(
      m->block_px % 2 == 1, "block_px",
      {FaultKind::kOutOfRange, fmt::format("{} is even; need {} or {}, with a middle", m->block_px,
                                           m->block_px - 1, m->block_px + 1)});
  archive->Visit("uniqueness_percent", &m->uniqueness_percent, Between(0, 100, "%"));
  archive->Visit("noise_dn", &m->noise_dn, Between(0, 100, "of 255"));
  archive->Visit("projector", &m->projector);
}

Stereo::Stereo(const StereoModel& model, const CameraIntrinsics& camera, double baseline_m,
               std::uint64_t seed, const std::string& stream_name)
    : model_(model),
      camera_(camera),
      baseline_m_(baseline_m),
      noise_(seed, stream_name + "/stereo") {
  if (model.projector) dots_.emplace(*model.projector, Stream(seed, stream_name + "/dots"));
}

Stereo::Eyes Stereo::Look(std::int64_t k, const SeenScene& scene, Rasterizer* rasterizer) const {
  const bool has_dots = dots_.has_value();
  const Pose X_CR = MakePose(Vec3(baseline_m_, 0, 0)),
             X_CP = MakePose(Vec3(0.5 * baseline_m_, 0, 0));
  Seen left = SeenFrom(camera_, scene.X_WC, scene.state, has_dots, rasterizer);
  Seen right = SeenFrom(camera_, scene.X_WC * X_CR, scene.state, has_dots, rasterizer);
  if (has_dots) {
    const Image<float> from_P_m =
        rasterizer->Render(camera_, scene.X_WC * X_CP, scene.state).depth_m;
    const Pose X_PL = X_CP.inverse(), X_PR = X_CP.inverse() * X_CR;
    AddDots(*model_.projector, *dots_, {camera_, X_PL, left.depth_m, left.light, from_P_m},
            &left.luminance_cdpm2);
    AddDots(*model_.projector, *dots_, {camera_, X_PR, right.depth_m, right.light, from_P_m},
            &right.luminance_cdpm2);
  }
  const std::vector<float>& light = left.luminance_cdpm2.data;
  const double mean_cdpm2 = std::accumulate(light.begin(), light.end(), 0.0) / double(light.size());
  const double per_cdpm2 = 255 * kMean / std::max(mean_cdpm2, kDarkest_cdpm2);
  const auto first = static_cast<std::uint64_t>(k) * 2 * light.size();
  return {Grey(left.luminance_cdpm2, per_cdpm2, model_.noise_dn, noise_, first),
          Grey(right.luminance_cdpm2, per_cdpm2, model_.noise_dn, noise_, first + light.size())};
}

Image<float> Stereo::Match(const Eyes& eyes) const {
  // Penalties for changes of disparity by one step and by more, as in OpenCV's samples.
  const int area = model_.block_px * model_.block_px, small = 8 * area, large = 32 * area;
  constexpr int kBothWays_px = 1, kCap = 31, kSpeckle_px = 60, kSpeckleRange_px = 2;
  const cv::Ptr<cv::StereoSGBM> matcher = cv::StereoSGBM::create(
      0, model_.disparities_px, model_.block_px, small, large, kBothWays_px, kCap,
      model_.uniqueness_percent, kSpeckle_px, kSpeckleRange_px, cv::StereoSGBM::MODE_SGBM);
  cv::Mat steps;
  matcher->compute(View(eyes.left), View(eyes.right), steps);
  Image<float> depth_m(camera_.width_px, camera_.height_px);
  for (int y = 0; y < camera_.height_px; ++y) {
    for (int x = 0; x < camera_.width_px; ++x) {
      const double disparity_px = steps.at<std::int16_t>(y, x) / kSteps;
      if (disparity_px <= 0) continue;
      depth_m.at(x, y) = static_cast<float>(camera_.fx_px * baseline_m_ / disparity_px);
    }
  }
  return depth_m;
}

Image<float> Stereo::Measure(std::int64_t k, const SeenScene& scene, Rasterizer* rasterizer) const {
  return Match(Look(k, scene, rasterizer));
}

}  // namespace tera
