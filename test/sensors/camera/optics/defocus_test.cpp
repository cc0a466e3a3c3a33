#include "sensors/camera/optics/defocus.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/units.h"

namespace tera {
namespace {

constexpr int kWidth = 96, kHeight = 80;

/// 8 mm at f/2, focused on 2 m, pixels of 5 um.
ThinLens Lens() {
  constexpr double kFocal_m = 8e-3, kFocus_m = 2;
  return {.pupil_m = kFocal_m / 2,
          .image_m = 1 / (1 / kFocal_m - 1 / kFocus_m),
          .pixel_m = 5e-6,
          .focus_m = kFocus_m};
}

Image<float> Filled(int channels, double value) {
  Image<float> picture(kWidth, kHeight, channels);
  std::fill(picture.data.begin(), picture.data.end(), static_cast<float>(value));
  return picture;
}

/// Distance from an edge through the middle that is steep by `slope` pixels a row.
double FromEdge(double x, double y, double slope) {
  return (x - 0.5 * kWidth + slope * (y - 0.5 * kHeight)) / std::sqrt(1 + slope * slope);
}

/// 1 and 5 cd/m^2 on the two sides, each pixel the mean over its area.
Image<float> SlantedEdge(double slope) {
  constexpr int kParts = 16;
  Image<float> picture(kWidth, kHeight, 3);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      int beyond = 0;
      for (int k = 0; k < kParts * kParts; ++k) {
        beyond += FromEdge(x - 0.5 + (k % kParts + 0.5) / kParts,
                           y - 0.5 + (k / kParts + 0.5) / kParts, slope) > 0;
      }
      for (int c = 0; c < 3; ++c) {
        picture.at(x, y, c) = 1 + 4 * static_cast<float>(beyond) / (kParts * kParts);
      }
    }
  }
  return picture;
}

/// Modulation at `cycles_per_px` by the slanted edge of ISO 12233: the edge's profile in quarters
/// of a pixel, its differences, their Fourier transform over that at zero.
double Modulation(const Image<float>& picture, double slope, double cycles_per_px) {
  constexpr int kReach = 20, kBins = 8 * kReach;
  std::vector<double> sum(kBins, 0), count(kBins, 0);
  for (int y = 12; y < kHeight - 12; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const int bin = static_cast<int>(std::floor(4 * (FromEdge(x, y, slope) + kReach)));
      if (bin < 0 || bin >= kBins) continue;
      sum[bin] += double(picture.at(x, y, 1));
      ++count[bin];
    }
  }
  double real = 0, imaginary = 0, zero = 0;
  for (int b = 1; b < kBins; ++b) {
    const double step = sum[b] / count[b] - sum[b - 1] / count[b - 1];
    const double phase = 2 * kPi * cycles_per_px * b / 4;
    real += step * std::cos(phase);
    imaginary += step * std::sin(phase);
    zero += step;
  }
  return std::hypot(real, imaginary) / zero;
}

/// Image distances by the lens equation 1 / f = 1 / z + 1 / z'; similar triangles behind the pupil.
TEST(ThinLens, DiscIsThatOfTheLensEquation) {
  const ThinLens lens = Lens();
  EXPECT_EQ(lens.Radius_px(2), 0);
  for (const double z_m : {1.0, 1.5, 3.0, 10.0}) {
    const double sharp_m = 1 / (1 / 8e-3 - 1 / z_m);
    const double disc_m = 4e-3 * std::abs(sharp_m - lens.image_m) / sharp_m;
    EXPECT_NEAR(lens.Radius_px(z_m), 0.5 * disc_m / 5e-6, 1e-9) << z_m;
  }
  EXPECT_NEAR(lens.Radius_px(0), lens.Radius_px(1e9), 1e-6);  // infinitely far
}

// The optical transfer function of a disc of radius r: 2 J1(x) / x, x = 2 pi nu r. Relative to the
// sharp picture, the pixels' and bins' parts cancel.
TEST(Defocus, ModulationOfASlantedEdgeIsThatOfADisc) {
  const ThinLens lens = Lens();
  const double slope = std::tan(5 * kDeg);
  const Image<float> sharp = SlantedEdge(slope);
  for (const double radius_px : {1.5, 2.5, 4.0}) {
    // c = A image (1 / z - 1 / focus) / 2 pixels.
    const double nearness = radius_px * 2 * lens.pixel_m / (lens.pupil_m * lens.image_m);
    const double z_m = 1 / (nearness + 1 / lens.focus_m);
    ASSERT_NEAR(lens.Radius_px(z_m), radius_px, 1e-9);
    const Image<float> blurred = Defocused(lens, DiscKernels(6), Filled(1, z_m), sharp);
    for (const double nu : {0.02, 0.05, 0.08, 0.1, 0.15, 0.2, 0.25}) {
      const double x = 2 * kPi * nu * radius_px;
      const double disc = std::abs(2 * std::cyl_bessel_j(1, x) / x);
      const double found = Modulation(blurred, slope, nu) / Modulation(sharp, slope, nu);
      EXPECT_NEAR(found, disc, 0.02) << radius_px << " px, " << nu << " cycles a pixel";
    }
  }
}

TEST(Defocus, WhatIsInFocusStaysAsItIs) {
  const Image<float> sharp = SlantedEdge(0.3);
  EXPECT_EQ(Defocused(Lens(), DiscKernels(8), Filled(1, 2), sharp).data, sharp.data);
}

TEST(Defocus, AnEvenPictureStaysEven) {
  Image<float> depth_m = Filled(1, 2);
  for (int x = 40; x < 60; ++x) {
    for (int y = 20; y < 50; ++y) depth_m.at(x, y) = x < 50 ? 0.9f : 0.0f;
  }
  const Image<float> even = Defocused(Lens(), DiscKernels(32), depth_m, Filled(3, 7));
  for (const float value : even.data) ASSERT_NEAR(value, 7, 1e-4);
}

/// Two halves of a picture, of depths and luminances left and right.
struct Halves {
  Image<float> depth_m = Filled(1, 0), light = Filled(3, 0);
  Halves(double left_m, double right_m, double left, double right) {
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        depth_m.at(x, y) = static_cast<float>(x < kWidth / 2 ? left_m : right_m);
        for (int c = 0; c < 3; ++c) {
          light.at(x, y, c) = static_cast<float>(x < kWidth / 2 ? left : right);
        }
      }
    }
  }
  Image<float> Seen() const { return Defocused(Lens(), DiscKernels(32), depth_m, light); }
};

TEST(Defocus, ABlurredBackgroundDoesNotRunOverWhatIsNearerAndSharp) {
  const Image<float> seen = Halves(2, 20, 1, 100).Seen();
  for (int x = 0; x < kWidth; ++x) {
    EXPECT_FLOAT_EQ(seen.at(x, 40, 0), x < kWidth / 2 ? 1 : 100) << x;
  }
}

// A disc whose middle lies `d` beyond an edge overlaps it by the segment (arccos u - u sqrt(1 -
// u^2)) / pi, u = d / r. The sharp background shows as far as the blurred foreground does not cover
// it, on both sides of its edge.
TEST(Defocus, ABlurredEdgeBeforeASharpBackgroundIsTheSegmentOfADisc) {
  const double near_m = 0.9, radius_px = Lens().Radius_px(near_m);
  ASSERT_NEAR(radius_px, 0.5 * 4e-3 * Lens().image_m * (1 / near_m - 0.5) / 5e-6, 1e-9);
  ASSERT_GT(radius_px, 1);
  const Image<float> seen = Halves(near_m, 2, 100, 0).Seen();
  const double rounded_px = std::round(8 * radius_px) / 8;
  for (int x = kWidth / 2 - 3; x < kWidth / 2 + 3; ++x) {
    const double u = std::clamp((x - (kWidth / 2 - 0.5)) / rounded_px, -1.0, 1.0);
    const double covered = (std::acos(u) - u * std::sqrt(1 - u * u)) / kPi;
    EXPECT_NEAR(seen.at(x, 40, 0), 100 * covered, 4) << x;
  }
}

}  // namespace
}  // namespace tera
