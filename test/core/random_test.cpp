#include "core/random.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tera {
namespace {

TEST(Stream, IsAFunctionOfSeedNameIndexAndLane) {
  const Stream a(7, "excavator1/imu_boom/gyro_white"), same(7, "excavator1/imu_boom/gyro_white");
  EXPECT_EQ(a.Gaussian(1234, 2), same.Gaussian(1234, 2));
  EXPECT_NE(a.Gaussian(1234, 2), a.Gaussian(1234, 3));
  EXPECT_NE(a.Gaussian(1234, 2), a.Gaussian(1235, 2));
  EXPECT_NE(a.Gaussian(0), Stream(8, "excavator1/imu_boom/gyro_white").Gaussian(0));
  EXPECT_NE(a.Gaussian(0), Stream(7, "excavator1/imu_arm/gyro_white").Gaussian(0));
}

TEST(Stream, GaussianHasZeroMeanUnitVarianceAndNoCorrelation) {
  const Stream stream(1, "test");
  constexpr int n = 200000;
  double sum = 0, squares = 0, products = 0, last = 0;
  for (int k = 0; k < n; ++k) {
    const double x = stream.Gaussian(k);
    sum += x;
    squares += x * x;
    products += x * last;
    last = x;
  }
  // Standard errors: mean 1/sqrt(n), variance sqrt(2/n), lag product 1/sqrt(n); five of each.
  const double e = 5.0 / std::sqrt(n);
  EXPECT_NEAR(sum / n, 0.0, e);
  EXPECT_NEAR(squares / n, 1.0, std::sqrt(2.0) * e);
  EXPECT_NEAR(products / n, 0.0, e);
}

TEST(Stream, UniformStaysInsideTheOpenIntervalWithItsMean) {
  const Stream stream(2, "uniform");
  constexpr int n = 100000;
  double sum = 0;
  for (int k = 0; k < n; ++k) {
    const double u = stream.Uniform(k);
    ASSERT_GT(u, 0.0);
    ASSERT_LT(u, 1.0);
    sum += u;
  }
  EXPECT_NEAR(sum / n, 0.5, 5.0 * std::sqrt(1.0 / 12.0 / n));
}

TEST(HashText, IsFnv1a) {
  // Published test vectors of 64-bit FNV-1a.
  EXPECT_EQ(HashText(""), 0xcbf29ce484222325ull);
  EXPECT_EQ(HashText("a"), 0xaf63dc4c8601ec8cull);
  EXPECT_EQ(HashText("foobar"), 0x85944171f73967e8ull);
}

}  // namespace
}  // namespace tera
