#include "sensors/camera/optics/glare.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/units.h"

namespace tera {
namespace {

CameraIntrinsics GlareLens() {
  return {.width_px = 161, .height_px = 121, .fx_px = 200, .fy_px = 200, .cx_px = 80, .cy_px = 60};
}

Image<float> Even(double value) {
  Image<float> picture(GlareLens().width_px, GlareLens().height_px, 3);
  std::fill(picture.data.begin(), picture.data.end(), static_cast<float>(value));
  return picture;
}

TEST(ScatterLaw, AllLightArrivesSomewhere) {
  for (const double slope : {1.5, 2.0, 3.0}) {
    const ScatterLaw law({.scattered = 0.02, .core_deg = 0.5, .slope = slope});
    double sum = 0;
    constexpr double kStep_rad = 1e-5;
    for (double t = 0.5 * kStep_rad; t < 1; t += kStep_rad)
      sum += 2 * kPi * t * law.At(t) * kStep_rad;
    EXPECT_NEAR(sum, 1, 1e-3) << slope;
  }
}

// Holladay's law: twice as far from a source the veil is a quarter.
TEST(ScatterLaw, OfSlopeTwoFallsWithTheSquareOfTheAngle) {
  const ScatterLaw law({.scattered = 0.02, .core_deg = 0.1, .slope = 2});
  EXPECT_NEAR(law.At(10 * kDeg) / law.At(5 * kDeg), 0.25, 1e-3);
}

TEST(PictureGlare, AnEvenPictureStaysEven) {
  Image<float> picture = Even(300);
  PictureGlare({.scattered = 0.1, .core_deg = 0.3, .slope = 2}, GlareLens())
      .Apply(Even(300), &picture);
  for (const float value : picture.data) ASSERT_NEAR(value, 300, 0.01);
}

// Veiling glare by ISO 9358's black spot in a bright field. The middle of a spot of angular radius
// R receives s times the light scattered from beyond it. For slope 2, that is 1 - ln(1 + (R /
// core)^2) / ln(1 + 1 / core^2).
TEST(PictureGlare, ABlackSpotIsVeiledByWhatLiesAroundIt) {
  constexpr double kScattered = 0.03, kCore_rad = 0.5 * kDeg, kSpot_px = 20;
  const CameraIntrinsics lens = GlareLens();
  Image<float> picture = Even(1000);
  for (int y = 0; y < lens.height_px; ++y) {
    for (int x = 0; x < lens.width_px; ++x) {
      if (Vec2(x - lens.cx_px, y - lens.cy_px).norm() > kSpot_px) continue;
      for (int c = 0; c < 3; ++c) picture.at(x, y, c) = 0;
    }
  }
  const Image<float> sources = picture;
  PictureGlare({.scattered = kScattered, .core_deg = 0.5, .slope = 2}, lens)
      .Apply(sources, &picture);
  const double spot_rad = kSpot_px / lens.fx_px;
  const double within =
      std::log1p(std::pow(spot_rad / kCore_rad, 2)) / std::log1p(1 / (kCore_rad * kCore_rad));
  // The spot darkens the mean by a twentieth; the mean represents the surroundings of the picture.
  const double beyond_mean = kPi * kSpot_px * kSpot_px / (lens.width_px * lens.height_px);
  EXPECT_NEAR(picture.at(80, 60, 1), 1000 * kScattered * (1 - within),
              1000 * kScattered * 0.6 * beyond_mean);
  EXPECT_GT(picture.at(80, 60, 1), 5);
}

// A source of E lx at the angle a from the axis adds a veil of s E cos(a) p(t) at the angle t from
// it. For slope 2, p = 1 / (pi core^2 ln(1 + 1 / core^2) (1 + (t / core)^2)).
TEST(SourceGlare, FollowsTheAngleFromASourceBeyondThePicture) {
  const GlareModel model{.scattered = 0.02, .core_deg = 0.5, .slope = 2};
  const Vec3 to_source_C(std::sin(35 * kDeg), 0, std::cos(35 * kDeg));
  std::vector<Vec3> rays_C;
  for (const double at_deg : {-10.0, 0.0, 20.0}) {
    rays_C.emplace_back(std::sin(at_deg * kDeg), 0, std::cos(at_deg * kDeg));
  }
  Image<float> picture(3, 1, 3);
  AddSourceGlare(model, rays_C, to_source_C, Vec3(1e5, 9e4, 8e4), &picture);
  const double core_rad = 0.5 * kDeg;
  for (const auto& [x, apart_deg] : {std::pair{0, 45.0}, {1, 35.0}, {2, 15.0}}) {
    const double per_sr = 1 / (kPi * core_rad * core_rad * std::log1p(1 / (core_rad * core_rad)) *
                               (1 + std::pow(apart_deg / 0.5, 2)));
    const double expected = 0.02 * std::cos(35 * kDeg) * per_sr;
    EXPECT_NEAR(picture.at(x, 0, 0), 1e5 * expected, 1e-3 * 1e5 * expected) << apart_deg;
    EXPECT_NEAR(picture.at(x, 0, 2), 8e4 * expected, 1e-3 * 8e4 * expected) << apart_deg;
  }
}

TEST(SourceGlare, ASourceBehindTheGlassGivesNone) {
  Image<float> picture(1, 1, 3);
  AddSourceGlare({}, {Vec3::UnitZ()}, Vec3(0.9, 0, -0.1).normalized(), Vec3(1e5, 1e5, 1e5),
                 &picture);
  EXPECT_EQ(picture.at(0, 0, 0), 0);
}

}  // namespace
}  // namespace tera
