#include "diagnose/search/fit/static_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "diagnose/statistics/series/simulated.h"

namespace tera {
namespace {

constexpr std::size_t kPlaces = 4000;

double RampOf(double u) {
  const double size = std::max(0.0, std::min(std::abs(u), 0.8) - 0.35);
  return u > 0 ? 1.4 * size : -0.9 * size;
}

// Steps of all sizes except 0.6, in both directions; the measurement is a ramp of the lever,
// delayed by 0.24 s.
TEST(StaticMap, IsALeversRampWithItsDeadTimeAlsoBetweenSizesThatWereDriven) {
  std::vector<double> lever(kPlaces), rate(kPlaces, 0.0);
  for (std::size_t k = 0; k < kPlaces; ++k) {
    const std::size_t turn = k / 100;
    const double size = 0.3 + 0.1 * static_cast<double>(turn % 8);
    const double driven = size > 0.55 && size < 0.65 ? 0.5 : size;
    lever[k] = k % 100 < 60 ? (turn / 8 % 2 ? -driven : driven) : 0;
    if (k >= 24) rate[k] = RampOf(lever[k - 24]);
  }
  const Series command = MakeSeries(0.01, lever), measured = MakeSeries(0.01, rate);
  const Mask all(kPlaces, 1);
  const PlainMap plain = FitPlainMap(command, measured, all);
  EXPECT_NEAR(plain.dead_time_s, 0.24, 1e-9);
  for (std::size_t k = 24; k < kPlaces; ++k) ASSERT_NEAR(plain.predicted[k], rate[k], 0.01) << k;
}

TEST(StaticMap, HatsOfALeverSumToItsShareOfTheFirstKnotAndOne) {
  const Eigen::MatrixXd hats = HatsOf(MakeSeries(0.01, {0.01, -0.33, 1, 0}), 0);
  EXPECT_NEAR(hats.row(0).sum(), 0.2, 1e-12);
  EXPECT_NEAR(hats.row(1).tail(kMapKnots).sum(), 1, 1e-12);
  EXPECT_NEAR(hats.row(1).head(kMapKnots).sum(), 0, 1e-12);
  EXPECT_NEAR(hats(2, kMapKnots - 1), 1, 1e-12);
  EXPECT_NEAR(hats.row(3).cwiseAbs().sum(), 0, 1e-12);
}

// A step through a lag of 0.2 s reaches 1 - 1/e of its height after 0.2 s.
TEST(StaticMap, HatsBehindALagFollowAStepByItsTime) {
  std::vector<double> lever(200, 0.5);
  std::fill(lever.begin(), lever.begin() + 100, 0.0);
  const Eigen::MatrixXd hats = HatsOf(MakeSeries(0.01, lever), 0.2);
  EXPECT_NEAR(hats(119, kMapKnots / 2 - 1), 1 - std::exp(-1), 1e-9);
}

}  // namespace
}  // namespace tera
