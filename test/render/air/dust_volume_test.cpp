#include "render/air/dust_volume.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "render/air/dust_box.h"
#include "render/air/sun_through_dust.h"

namespace tera {
namespace {

using testing::DustBox;

TEST(DustVolume, OpticalDepthThroughEvenDustIsExtinctionTimesWay) {
  // Cells from x = -2 to 6 with 0.3 / m, falling to zero over half a cell beyond them. A line
  // through the middle has 8 m of full extinction, since the edges' loss inside equals their gain
  // outside.
  const DustVolume dust = DustBox(Vec3(-2, 1, 4), 0.5, {16, 12, 8}, 0.3);
  const Vec3 origin(-20, 4, 6);
  constexpr double kFar = std::numeric_limits<double>::infinity();
  EXPECT_NEAR(OpticalDepth(dust, origin, Vec3::UnitX(), kFar), 0.3 * 8, 0.02);
  EXPECT_NEAR(OpticalDepth(dust, origin, Vec3::UnitX(), 21), 0.3 * 3, 0.02);
  EXPECT_EQ(OpticalDepth(dust, origin, -Vec3::UnitX(), kFar), 0);
  const Vec3 slanted = Vec3(1, 0, 0.2).normalized();
  EXPECT_NEAR(OpticalDepth(dust, origin - Vec3(0, 0, 3.5), slanted, kFar),
              0.3 * 8 * slanted.norm() / slanted.x(), 0.1);
}

TEST(DustVolume, FollowsTheGroundAndFillsPits) {
  DustVolume dust = DustBox(Vec3(0, 0, 10), 1, {8, 8, 2}, 0.5);
  for (int j = 0; j < 8; ++j) {
    for (int i = 0; i < 8; ++i) dust.base_m[j * 8 + i] = static_cast<float>(10 + i);
  }
  EXPECT_NEAR(dust.Extinction_1pm(Vec3(5.5, 4, 15.9)), 0.5, 1e-6);
  EXPECT_NEAR(dust.Extinction_1pm(Vec3(5.5, 4, 17.6)), 0, 1e-6) << "above the two layers there";
  EXPECT_NEAR(dust.Extinction_1pm(Vec3(2.5, 4, 8)), 0.5, 1e-6) << "in a pit";
}

TEST(DustVolume, EddiesKeepTheMeanAndRepeat) {
  const DustEddies eddies;
  double sum = 0, squares = 0;
  for (const float f : eddies.factors()) {
    ASSERT_GT(f, 0);
    sum += f;
    squares += static_cast<double>(f) * f;
  }
  const auto n = static_cast<double>(eddies.factors().size());
  EXPECT_NEAR(sum / n, 1, 1e-6);
  // A log-normal factor of mean 1 has the variance exp(s^2) - 1. A period holds some tens of the
  // largest whirls, so that its own variance is known to about a fifth.
  const double variance = std::exp(DustEddies::kSpread * DustEddies::kSpread) - 1;
  EXPECT_NEAR(squares / n - 1, variance, 0.35 * variance);
  const Vec3 p(1.3, -4.1, 0.7);
  EXPECT_NEAR(eddies.At(p), eddies.At(p + DustEddies::kPeriod_m * Vec3(1, -2, 3)), 1e-9);
  EXPECT_NE(eddies.At(p), eddies.At(p + Vec3(1, 0, 0)));
}

TEST(SunThroughDust, EvenDustShadesByTheWayToItsTop) {
  // 8 layers of 0.5 m with 0.4 / m under a sun at 30 degrees. From the middle of the lowest one,
  // 3.75 m below the top, the path is twice as long. Steps are a cell long and sample cells at
  // their middles, so that the sum may err by a cell.
  const DustVolume dust = DustBox(Vec3(0, 0, 0), 0.5, {60, 10, 8}, 0.4);
  const double c = std::sqrt(0.75);
  const std::vector<float> depths = OpticalDepthsToSun(dust, Vec3(c, 0, 0.5));
  EXPECT_NEAR(depths[4 * 60 + 10], 0.4 * 3.75 * 2, 0.4 * 0.5);
  EXPECT_NEAR(OpticalDepthsToSun(dust, Vec3::UnitZ())[4 * 60 + 10], 0.4 * 3.75, 1e-5);
}

}  // namespace
}  // namespace tera
