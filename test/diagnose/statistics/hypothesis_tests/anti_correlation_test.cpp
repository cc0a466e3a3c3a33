#include "diagnose/statistics/hypothesis_tests/anti_correlation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/random.h"

namespace tera {
namespace {

constexpr std::size_t kOppositionSize = 2000;

/// Autoregressive noise about zero.
std::vector<double> Noise(const std::string& name, std::uint64_t seed, double coefficient) {
  const Stream draw(seed, name);
  std::vector<double> values;
  double last = 0;
  for (std::size_t k = 0; k < kOppositionSize; ++k) {
    last = coefficient * last + draw.Gaussian(k);
    values.push_back(last);
  }
  return values;
}

/// Number of 400 pairs of independent series with a p of at most `level`.
int Rejected(double coefficient, double level) {
  int rejected = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    const double p =
        AntiCorrelationPValue(Noise("a", seed, coefficient), Noise("b", seed, coefficient));
    rejected += p <= level;
  }
  return rejected;
}

// Among 400 trials, four are expected below a level of 0.01 and two hundred below 0.5; five
// standard errors are 10 and 50.
TEST(Opposition, OfWhiteNoiseHasAUniformP) {
  EXPECT_LE(Rejected(0, 0.01), 14);
  EXPECT_NEAR(Rejected(0, 0.5), 200, 50);
}

TEST(Opposition, OfStubbornNoiseIsSeldomTold) { EXPECT_LE(Rejected(0.95, 0.01), 14); }

TEST(Opposition, OfSeriesThatGoAgainstEachOtherHasAVerySmallP) {
  const std::vector<double> one = Noise("one", 1, 0.9), noise = Noise("noise", 1, 0);
  std::vector<double> other(kOppositionSize), same(kOppositionSize);
  for (std::size_t k = 0; k < kOppositionSize; ++k) {
    other[k] = -0.5 * one[k] + 0.2 * noise[k];
    same[k] = -other[k];
  }
  EXPECT_LT(AntiCorrelationPValue(one, other), 1e-12);
  EXPECT_GT(AntiCorrelationPValue(one, same), 0.999);
}

TEST(Opposition, OfFewerThanThreeBlocksSaysNothing) {
  std::vector<double> one, other;
  for (std::size_t k = 0; k < kOppositionSize; ++k) {
    const double at = static_cast<double>(k) / kOppositionSize;
    one.push_back(std::sin(3 * at));
    other.push_back(-one.back());
  }
  EXPECT_EQ(AntiCorrelationPValue(one, other), 1);
}

}  // namespace
}  // namespace tera
