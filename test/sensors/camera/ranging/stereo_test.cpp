#include "sensors/camera/ranging/stereo.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "render/hand_made_scene.h"
#include "sensors/camera/camera.h"

namespace tera {
namespace {

using testing::OneBodyEach;
using testing::WallMesh;

constexpr int kWidth = 240, kHeight = 100;
constexpr double kFocal_px = 200, kBaseline_m = 0.1;

CameraIntrinsics Lens() {
  return {.width_px = kWidth,
          .height_px = kHeight,
          .fx_px = kFocal_px,
          .fy_px = kFocal_px,
          .cx_px = 119.5,
          .cy_px = 49.5};
}

Stereo Matcher(const StereoModel& model = {.disparities_px = 48}) {
  return {model, Lens(), kBaseline_m, 1, "m/camera"};
}

/// Random grey, smooth between the pixels of a row.
double Texture(double x, int y) {
  const Stream draw(1, "texture");
  const auto at = [&](double column) {
    return draw.Uniform(static_cast<std::uint64_t>(y) * 4096 +
                        static_cast<std::uint64_t>(column + 999));
  };
  const double left = std::floor(x);
  return 40 + 180 * ((1 - (x - left)) * at(left) + (x - left) * at(left + 1));
}

/// Pictures of textured surfaces in both eyes, from the disparity of each place in the right eye's
/// picture.
template <typename DisparityOfRight>
Stereo::Eyes EyesBefore(double disparity_left_px, const DisparityOfRight& right_px) {
  Stereo::Eyes eyes{Image<std::uint8_t>(kWidth, kHeight), Image<std::uint8_t>(kWidth, kHeight)};
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      eyes.left.at(x, y) = static_cast<std::uint8_t>(Texture(x - disparity_left_px, y) + 0.5);
      eyes.right.at(x, y) =
          static_cast<std::uint8_t>(Texture(x - disparity_left_px + right_px(x), y) + 0.5);
    }
  }
  return eyes;
}

// A plane at the depth z has the disparity f b / z everywhere: 20 px at 1 m.
TEST(Stereo, APlaneIsFoundAtItsDepth) {
  const Image<float> depth_m = Matcher().Match(EyesBefore(0, [](int) { return 20.0; }));
  int found = 0;
  for (int y = 4; y < kHeight - 4; ++y) {
    for (int x = 56; x < kWidth - 8; ++x) {
      if (depth_m.at(x, y) == 0) continue;
      ++found;
      ASSERT_NEAR(depth_m.at(x, y), kFocal_px * kBaseline_m / 20, 1.0 / 16 / 20) << x << " " << y;
    }
  }
  EXPECT_GT(found, 0.97 * (kHeight - 8) * (kWidth - 64));
}

// Depth comes in steps of a sixteenth of a pixel of disparity: z^2 / (f b) / 16. The matcher's
// subpixel fractions are biased towards integers by up to a quarter, as those of real matchers
// ("pixel locking": Shimizu and Okutomi 2001, "Precise sub-pixel estimation on area-based
// matching").
TEST(Stereo, DepthIsQuantisedByTheDisparity) {
  const Image<float> depth_m = Matcher().Match(EyesBefore(0, [](int) { return 12.37; }));
  std::vector<double> levels_m;
  for (const float z_m : depth_m.data) {
    if (z_m == 0) continue;
    const double steps = 16 * kFocal_px * kBaseline_m / double(z_m);
    ASSERT_NEAR(steps, std::round(steps), 1e-3);
    levels_m.push_back(double(z_m));
  }
  std::ranges::sort(levels_m);
  const double median_m = levels_m[levels_m.size() / 2], z_m = kFocal_px * kBaseline_m / 12.37;
  const double step_m = z_m * z_m / (kFocal_px * kBaseline_m) / 16;
  EXPECT_NEAR(median_m, z_m, 5 * step_m);
  const auto next = std::ranges::upper_bound(levels_m, median_m + 1e-9);
  ASSERT_NE(next, levels_m.end());
  EXPECT_NEAR(*next - median_m, step_m, 0.05 * step_m);
}

/// A wall of dots and a square in front of it, as the eyes see them. The square occludes f b / z1 -
/// f b / z2 pixels of the wall to its left from the right eye.
TEST(Stereo, BesideANearThingIsAShadowAsWideAsItsDisparity) {
  constexpr double kNear_px = 40, kFar_px = 12;
  constexpr int kFrom = 130, kTo = 190;  // of the square in the left picture
  Stereo::Eyes eyes{Image<std::uint8_t>(kWidth, kHeight), Image<std::uint8_t>(kWidth, kHeight)};
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const bool near_left = x >= kFrom && x < kTo;
      const bool near_right = x + kNear_px >= kFrom && x + kNear_px < kTo;
      eyes.left.at(x, y) = static_cast<std::uint8_t>(Texture(near_left ? x + 2000 : x, y));
      eyes.right.at(x, y) =
          static_cast<std::uint8_t>(Texture(near_right ? x + kNear_px + 2000 : x + kFar_px, y));
    }
  }
  const Image<float> depth_m = Matcher({.disparities_px = 64}).Match(eyes);
  double shadow_px = 0;
  int rows = 0;
  for (int y = 20; y < kHeight - 20; ++y, ++rows) {
    for (int x = 80; x < kFrom + 8; ++x) shadow_px += depth_m.at(x, y) == 0;
    EXPECT_NEAR(depth_m.at(160, y), kFocal_px * kBaseline_m / kNear_px, 0.02);
    EXPECT_NEAR(depth_m.at(85, y), kFocal_px * kBaseline_m / kFar_px, 0.05);
  }
  EXPECT_NEAR(shadow_px / rows, kNear_px - kFar_px, 4);
}

TEST(Stereo, WithoutTextureNothingMatches) {
  const Image<float> depth_m =
      Matcher({.disparities_px = 48, .uniqueness_percent = 10})
          .Match({Image<std::uint8_t>(kWidth, kHeight), Image<std::uint8_t>(kWidth, kHeight)});
  EXPECT_LT(std::ranges::count_if(depth_m.data, [](float z_m) { return z_m > 0; }), 200);
}

/// A camera 1.6 m before a smooth wall without any texture to match.
class BeforeASmoothWall : public ::testing::Test {
 protected:
  BeforeASmoothWall() : model_(OneBodyEach({WallMesh(4, 0.5)})), rasterizer_(model_, {}) {
    seen_.X_WC = MakePose({1, 2, 40}, 0, 0, 90 * kDeg) * OpticalInSensor();
    seen_.state.X_WB = {MakePose({1, 3.6, 40}, 0, 0, 90 * kDeg)};
  }
  /// Share of the pixels with a depth within five steps.
  double Right(const StereoModel& model) {
    const Image<float> depth_m = Matcher(model).Measure(0, seen_, &rasterizer_);
    const double step_m = 1.6 * 1.6 / (kFocal_px * kBaseline_m) / 16;
    double right = 0;
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 48; x < kWidth; ++x)
        right += std::abs(double(depth_m.at(x, y)) - 1.6) < 5 * step_m;
    }
    return right / (kHeight * (kWidth - 48));
  }

  SceneModel model_;
  Rasterizer rasterizer_;
  SeenScene seen_;
};

TEST_F(BeforeASmoothWall, DotsMakeItSeen) {
  StereoModel model{.disparities_px = 48};
  EXPECT_LT(Right(model), 0.3);
  model.projector = DotProjector{.intensity_cd = 2e5, .cell_deg = 1.2, .dot_share = 0.2};
  EXPECT_GT(Right(model), 0.8);
}

// Daylight outshines the dots of a weak projector.
TEST_F(BeforeASmoothWall, WeakDotsDrownInTheNoise) {
  StereoModel model{.disparities_px = 48};
  model.projector = DotProjector{.intensity_cd = 10, .cell_deg = 1.2, .dot_share = 0.2};
  EXPECT_LT(Right(model), 0.3);
}

// The projector's dots lie on the wall: seen from both eyes their disparity is f b / z.
TEST_F(BeforeASmoothWall, SameSeedSameDots) {
  StereoModel model{.disparities_px = 48};
  model.projector = DotProjector{.intensity_cd = 2e5, .cell_deg = 1.2};
  const Stereo::Eyes a = Matcher(model).Look(3, seen_, &rasterizer_);
  const Stereo::Eyes b = Matcher(model).Look(3, seen_, &rasterizer_);
  EXPECT_EQ(a.left.data, b.left.data);
  EXPECT_EQ(a.right.data, b.right.data);
  EXPECT_NE(Matcher(model).Look(4, seen_, &rasterizer_).left.data, a.left.data);
}

}  // namespace
}  // namespace tera
