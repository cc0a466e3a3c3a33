#include "sensors/camera/optics/soiling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace tera {
namespace {

constexpr double kFocal_px = 400, kPupil_mm = 0.5;

CameraIntrinsics SoilingLens() {
  return {.width_px = 320,
          .height_px = 240,
          .fx_px = kFocal_px,
          .fy_px = kFocal_px,
          .cx_px = 159.5,
          .cy_px = 119.5};
}

Soiling On(const SoilingModel& model, std::uint64_t seed = 1) {
  return {model, SoilingLens(), kPupil_mm, Stream(seed, "m/camera/soiling"), "m/camera"};
}

Image<float> SoilingEven(double value) {
  Image<float> picture(SoilingLens().width_px, SoilingLens().height_px, 3);
  std::fill(picture.data.begin(), picture.data.end(), static_cast<float>(value));
  return picture;
}

double MeanOf(const Image<float>& picture) {
  return std::accumulate(picture.data.begin(), picture.data.end(), 0.0) /
         static_cast<double>(picture.data.size());
}

// By similar triangles a point on the glass is seen under pupil / distance.
TEST(Soiling, DirtIsSpreadOverThePupilSeenFromTheGlass) {
  EXPECT_NEAR(On({.distance_mm = 20, .film = 0.1}).disc_px(), kFocal_px * 0.5 / 20, 1e-9);
}

TEST(Soiling, AFilmTakesItsShareOnAverage) {
  const Soiling soiling = On({.film = 0.2});
  EXPECT_NEAR(MeanOf(soiling.transmitted()), 0.8, 0.04);  // of 36 numbers of the coarsest noise
  const auto [least, most] = std::ranges::minmax(soiling.transmitted().data);
  EXPECT_LT(least, 0.78);
  EXPECT_GT(most, 0.82);
}

// A speck much larger than the disc hides at least half of the light in its middle. One much
// smaller removes less than the ratio of both areas from each pixel.
TEST(Soiling, SmallSpecksAreOutOfFocus) {
  const auto darkest = [](const SoilingModel& model) {
    return *std::ranges::min_element(On(model).transmitted().data);
  };
  EXPECT_LT(darkest({.distance_mm = 20, .specks = 4, .speck_mm = 3}), 0.5);
  EXPECT_GT(darkest({.distance_mm = 20, .specks = 1, .speck_mm = 0.05}), 0.9);
}

TEST(Soiling, OfTheLightThatAFilmTakesAShareComesAsAVeil) {
  const Soiling soiling = On({.film = 0.3});
  Image<float> picture = SoilingEven(1000);
  soiling.Apply(Vec3::Zero(), &picture);
  for (std::size_t i = 0; i < picture.data.size(); i += 101) {
    const double clear = double(soiling.transmitted().data[i / 3]);
    EXPECT_NEAR(picture.data[i], 1000 * (clear + Soiling::kScattered * (1 - clear)), 0.5);
  }
  Image<float> sunlit = SoilingEven(1000);
  soiling.Apply(Vec3::Constant(5e4), &sunlit);
  const double clear = double(soiling.transmitted().at(100, 100));
  EXPECT_NEAR(sunlit.at(100, 100, 1) - picture.at(100, 100, 1),
              Soiling::kScattered * (1 - clear) * 5e4 / 3.14159265, 1);
}

TEST(Soiling, SpecksAreDarkBesideAFilm) {
  const Soiling soiling = On({.specks = 20, .speck_mm = 2});
  Image<float> picture = SoilingEven(1000);
  soiling.Apply(Vec3::Zero(), &picture);
  for (std::size_t i = 0; i < picture.data.size(); i += 101) {
    const double clear = double(soiling.transmitted().data[i / 3]);
    EXPECT_NEAR(picture.data[i], 1000 * (clear + Soiling::kSpeckScattered * (1 - clear)), 0.5);
  }
}

// A flat cap of a sphere of radius R is a plano-convex lens of focal length R / (n - 1), which
// deflects rays at height h by h / f.
TEST(Soiling, ADropTurnsRaysAsALensOfWater) {
  const double sphere_mm = 4, px_per_mm = 20;
  const Vec2 from_px(0.02 * px_per_mm, -0.01 * px_per_mm);  // near its axis
  const Vec2 turned_rad =
      (Soiling::Turned_px(from_px, px_per_mm, kFocal_px, sphere_mm) - from_px) / kFocal_px;
  EXPECT_NEAR(turned_rad.x(), -0.02 / (4 / 0.33), 1e-6);
  EXPECT_NEAR(turned_rad.y(), 0.01 / (4 / 0.33), 1e-6);
}

TEST(Soiling, DropsOfClearWaterLeaveAnEvenPictureEven) {
  const Soiling soiling = On({.drops = 10});
  Image<float> picture = SoilingEven(1000);
  soiling.Apply(Vec3::Constant(1e5), &picture);
  for (const float value : picture.data) ASSERT_NEAR(value, 1000, 0.5);
  EXPECT_LT(MeanOf(soiling.transmitted()), 0.999) << "but they let nothing through undeviated";
}

// Objects on the left appear on the right in a drop.
TEST(Soiling, ADropShowsTheSceneTurnedRound) {
  Image<float> ramp = SoilingEven(0);
  for (int y = 0; y < ramp.height_px; ++y) {
    for (int x = 0; x < ramp.width_px; ++x) {
      for (int c = 0; c < 3; ++c) ramp.at(x, y, c) = static_cast<float>(x);
    }
  }
  const Soiling soiling = On({.distance_mm = 40, .drops = 1, .drop_mm = 6}, 3);
  Image<float> picture = ramp;
  soiling.Apply(Vec3::Zero(), &picture);
  int falls = 0, rises = 0;
  for (int y = 1; y < ramp.height_px - 1; ++y) {
    for (int x = 1; x < ramp.width_px - 1; ++x) {
      if (soiling.transmitted().at(x, y) > 0.001f) continue;
      (picture.at(x + 1, y, 0) < picture.at(x - 1, y, 0) ? falls : rises) += 1;
    }
  }
  EXPECT_GT(falls, 100);
  EXPECT_LT(rises, 0.2 * falls);
}

TEST(Soiling, TheSeedDrawsTheDirt) {
  const SoilingModel model{.film = 0.1, .specks = 20, .drops = 5};
  EXPECT_EQ(On(model).transmitted().data, On(model).transmitted().data);
  EXPECT_NE(On(model).transmitted().data, On(model, 2).transmitted().data);
}

}  // namespace
}  // namespace tera
