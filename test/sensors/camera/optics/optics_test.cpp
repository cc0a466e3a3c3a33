#include "sensors/camera/optics/optics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "core/units.h"
#include "render/hand_made_scene.h"
#include "sensors/camera/camera.h"

namespace tera {
namespace {

using testing::OneBodyEach;
using testing::WallMesh;

/// A camera that looks along +x of W, the sun ahead at 20 degrees to its left and 10 degrees high,
/// and an optional wall in front of the sun.
class CameraBeforeTheSun : public ::testing::Test {
 protected:
  CameraBeforeTheSun() : model_(OneBodyEach({WallMesh(2, 0.5)})) {
    model_.environment.to_sun_W = kToSun_W;
    rasterizer_.emplace(model_, EglOptions{});
    lens_ = {
        .width_px = 161, .height_px = 121, .fx_px = 150, .fy_px = 150, .cx_px = 80, .cy_px = 60};
    seen_.X_WC = MakePose({1, 2, 40}, 0, 0, 0) * OpticalInSensor();
    seen_.state.X_WB = {MakePose({-50, 0, 40}, 0, 0, 0)};
  }

  /// Light added to a picture that is otherwise dark.
  Image<float> OnTop(const OpticsModel& model) {
    Image<float> picture(lens_.width_px, lens_.height_px, 3);
    const Image<float> depth_m(lens_.width_px, lens_.height_px);
    Optics(model, lens_, 4, 3.45, 1, "m/camera").Apply(seen_, depth_m, &*rasterizer_, &picture);
    return picture;
  }
  static double SumOf(const Image<float>& picture) {
    return std::accumulate(picture.data.begin(), picture.data.end(), 0.0);
  }

  static inline const Vec3 kToSun_W =
      Vec3(std::cos(10 * kDeg) * std::cos(20 * kDeg), std::cos(10 * kDeg) * std::sin(20 * kDeg),
           std::sin(10 * kDeg));
  SceneModel model_;
  std::optional<Rasterizer> rasterizer_;
  CameraIntrinsics lens_;
  SeenScene seen_;
};

// In the middle of the picture the sun's veil is s E cos(a) p(a), with a the sun's angle from the
// axis (p in glare_test). It fades away from the sun, which is on the left.
TEST_F(CameraBeforeTheSun, TheSunVeilsThePictureByItsAngle) {
  const GlareModel glare{.scattered = 0.02, .core_deg = 0.5, .slope = 2};
  const Image<float> veil = OnTop({.glare = glare});
  const double apart_rad = std::acos(kToSun_W.x()), core_rad = 0.5 * kDeg;
  const double per_sr = 1 / (kPi * core_rad * core_rad * std::log1p(1 / (core_rad * core_rad)) *
                             (1 + std::pow(apart_rad / core_rad, 2)));
  const double expected = 0.02 * rasterizer_->sun_illuminance_lx().y() * kToSun_W.x() * per_sr;
  EXPECT_NEAR(veil.at(80, 60, 1), expected, 0.01 * expected);
  EXPECT_GT(veil.at(40, 40, 1), 2 * veil.at(120, 80, 1));
}

TEST_F(CameraBeforeTheSun, AWallBeforeTheSunTakesVeilAndGhostsAway) {
  const OpticsModel both{.glare = GlareModel{}, .flare = FlareModel{.ghosts = 8}};
  EXPECT_GT(SumOf(OnTop({.flare = FlareModel{.ghosts = 8}})), 1);
  EXPECT_GT(SumOf(OnTop(both)), 100);
  seen_.state.X_WB = {MakePose(seen_.X_WC.translation() + 5 * kToSun_W, 0, 0, 20 * kDeg)};
  EXPECT_EQ(SumOf(OnTop(both)), 0);
}

TEST_F(CameraBeforeTheSun, BehindItTheSunVeilsNothing) {
  seen_.X_WC = MakePose({1, 2, 40}, 0, 0, 180 * kDeg) * OpticalInSensor();
  EXPECT_EQ(SumOf(OnTop({.glare = GlareModel{}})), 0);
}

TEST_F(CameraBeforeTheSun, TheLabelOfSoilingIsWhatComesThrough) {
  const OpticsModel model{.soiling = SoilingModel{.film = 0.2}};
  const Image<std::uint8_t> label = Optics(model, lens_, 4, 3.45, 1, "m/camera").SoilingLabel();
  // Even light of 1000: T + scattered (1 - T) of it arrive, without a sun.
  seen_.X_WC = MakePose({1, 2, 40}, 0, 0, 180 * kDeg) * OpticalInSensor();
  Image<float> picture(lens_.width_px, lens_.height_px, 3);
  std::ranges::fill(picture.data, 1000.0f);
  Optics(model, lens_, 4, 3.45, 1, "m/camera")
      .Apply(seen_, Image<float>(lens_.width_px, lens_.height_px), &*rasterizer_, &picture);
  for (const auto& [x, y] : {std::pair{10, 10}, {80, 60}, {150, 110}, {33, 97}}) {
    const double clear =
        (picture.at(x, y, 0) / 1000 - Soiling::kScattered) / (1 - Soiling::kScattered);
    EXPECT_NEAR(label.at(x, y), 255 * clear, 0.6) << x << " " << y;
  }
}

TEST(PixelOfShare, IsOf255) {
  EXPECT_EQ(PixelOfShare(1), 255);
  EXPECT_EQ(PixelOfShare(0.5), 128);
  EXPECT_EQ(PixelOfShare(-0.1), 0);
}

}  // namespace
}  // namespace tera
