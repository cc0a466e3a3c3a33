#include "render/air/wet_surface.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/units.h"

namespace tera {
namespace {

/// Fresnel's reflectance of unpolarised light that goes from an index of 1 to n.
double Fresnel(double cos_in, double n) {
  const double sin2_out = (1 - cos_in * cos_in) / (n * n);
  if (sin2_out >= 1) return 1;
  const double cos_out = std::sqrt(1 - sin2_out);
  const double s = (cos_in - n * cos_out) / (cos_in + n * cos_out);
  const double p = (cos_out - n * cos_in) / (cos_out + n * cos_in);
  return 0.5 * (s * s + p * p);
}

/// Reflectance of diffuse light: the mean over a hemisphere, weighted by the cosine.
double Diffuse(double n) {
  constexpr int kSteps = 20000;
  double sum = 0;
  for (int k = 0; k < kSteps; ++k) {
    const double cos2 = (k + 0.5) / kSteps;
    sum += Fresnel(std::sqrt(cos2), n) / kSteps;
  }
  return sum;
}

TEST(WetSurface, IsTheSumOfAllReflectionsUnderTheFilm) {
  const double enters = 1 - Fresnel(1, 1.33);
  const double held_back = Diffuse(1 / 1.33);  // from within
  for (const double r : {0.05, 0.2, 0.5, 0.8}) {
    double left = 0, light = enters;
    for (int bounce = 0; bounce < 200; ++bounce) {
      light *= r;
      left += light * (1 - held_back);
      light *= held_back;
    }
    EXPECT_NEAR(WetReflectance(r), left, 0.005 * r) << r;
  }
}

TEST(WetSurface, MiddleTonesDarkenMostAndWhiteAndBlackStay) {
  EXPECT_EQ(WetReflectance(0), 0);
  EXPECT_NEAR(WetReflectance(1), 0.98, 1e-12);
  EXPECT_NEAR(WetReflectance(0.3) / 0.3, 0.60, 0.01);
  EXPECT_LT(WetReflectance(0.3) / 0.3, WetReflectance(0.8) / 0.8);
}

}  // namespace
}  // namespace tera
