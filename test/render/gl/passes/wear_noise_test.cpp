#include "render/gl/passes/wear_noise.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tera {
namespace {

TEST(WearNoise, HasTheMeanAndTheSpreadThatTheShaderCountsOn) {
  const WearNoise noise = MakeWearNoise();
  const std::size_t cells = noise.rg.size() / 2;
  ASSERT_EQ(cells, 64u * 64 * 64);
  for (const std::size_t channel : {0u, 1u}) {
    double mean = 0, square = 0;
    for (std::size_t n = 0; n < cells; ++n) {
      const double v = noise.rg[2 * n + channel] / 255.0;
      mean += v / static_cast<double>(cells);
      square += v * v / static_cast<double>(cells);
    }
    EXPECT_NEAR(mean, 0.5, 0.01);
    EXPECT_NEAR(std::sqrt(square - mean * mean), 0.2, 0.01);
  }
}

TEST(WearNoise, GoesOnWithoutASeam) {
  const WearNoise noise = MakeWearNoise();
  constexpr int kSide = WearNoise::kSide;
  const auto at = [&](int i, int j, int k) {
    return static_cast<int>(noise.rg[2 * ((static_cast<std::size_t>(k) * kSide + j) * kSide + i)]);
  };
  double across = 0, within = 0;
  for (int k = 0; k < kSide; ++k) {
    for (int j = 0; j < kSide; ++j) {
      across += std::abs(at(kSide - 1, j, k) - at(0, j, k));
      within += std::abs(at(31, j, k) - at(32, j, k));
    }
  }
  EXPECT_LT(across, 1.3 * within);
}

}  // namespace
}  // namespace tera
