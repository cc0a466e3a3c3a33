#include "sensors/encoder/encoder.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/units.h"

namespace tera {
namespace {

TEST(Encoder, ReadsAnglesAndRatesAtItsOwnTime) {
  const Encoder encoder({}, {.rate_hz = 50, .start_ns = 5}, 1000, 1, "m/joints");
  const EncoderSample s = encoder.Measure(3, {0.1, -0.2}, {1, 2});
  EXPECT_EQ(s.t_ns, 60'000'005);
  EXPECT_EQ(s.t_available_ns, 60'001'005);
  EXPECT_EQ(s.q_rad, (std::vector<double>{0.1, -0.2}));
  EXPECT_EQ(s.qd_radps, (std::vector<double>{1, 2}));
}

TEST(Encoder, AnglesAreRoundedToTheNearestCount) {
  EncoderModel model;
  model.resolution_rad = 0.25;
  const Encoder encoder(model, {.rate_hz = 50}, 0, 1, "m/joints");
  const EncoderSample s = encoder.Measure(0, {0.3, 0.4, -0.13}, {0.3, 0, 0});
  EXPECT_EQ(s.q_rad, (std::vector<double>{0.25, 0.5, -0.25}));
  EXPECT_EQ(s.qd_radps[0], 0.3);
}

TEST(Encoder, ReadsTheTravelOfPrismaticJointsInMetres) {
  EncoderModel model;
  model.resolution_rad = 0.25;
  model.resolution_m = 0.02;
  const Encoder quantised(model, {.rate_hz = 50}, 0, 1, "m/joints", {false, true});
  EXPECT_EQ(quantised.Measure(0, {0.3, 0.31}, {0, 0}).q_rad, (std::vector<double>{0.25, 0.32}));

  // Noise of the other kind of axis has no effect.
  model = {};
  model.noise_rad = model.rate_noise_radps = 1;
  const EncoderSample turned =
      Encoder(model, {.rate_hz = 50}, 0, 1, "m/joints", {false, true}).Measure(0, {1, 2}, {3, 4});
  EXPECT_TRUE(turned.q_rad[0] != 1 && turned.qd_radps[0] != 3);
  EXPECT_TRUE(turned.q_rad[1] == 2 && turned.qd_radps[1] == 4);
  model = {};
  model.noise_m = model.rate_noise_mps = 1;
  const EncoderSample slid =
      Encoder(model, {.rate_hz = 50}, 0, 1, "m/joints", {false, true}).Measure(0, {1, 2}, {3, 4});
  EXPECT_TRUE(slid.q_rad[0] == 1 && slid.qd_radps[0] == 3);
  EXPECT_TRUE(slid.q_rad[1] != 2 && slid.qd_radps[1] != 4);
}

TEST(Encoder, NoiseHasItsDeviationAndIsIndependentBetweenJoints) {
  // n = 10000: five standard errors of a variance 5 sqrt(2/n) = 7 %, of a correlation 0.05.
  EncoderModel model;
  model.noise_rad = 0.01;
  model.rate_noise_radps = 0.2;
  const Encoder encoder(model, {.rate_hz = 50}, 0, 1, "m/joints");
  double angle = 0, rate = 0, cross = 0;
  constexpr int kCount = 10000;
  for (int k = 0; k < kCount; ++k) {
    const EncoderSample s = encoder.Measure(k, {0.5, 0.5}, {1, 1});
    angle += std::pow(s.q_rad[0] - 0.5, 2) / kCount;
    rate += std::pow(s.qd_radps[0] - 1, 2) / kCount;
    cross += (s.q_rad[0] - 0.5) * (s.q_rad[1] - 0.5) / kCount;
  }
  EXPECT_NEAR(angle, 1e-4, 0.07e-4);
  EXPECT_NEAR(rate, 0.04, 0.07 * 0.04);
  EXPECT_NEAR(cross / 1e-4, 0, 0.05);
}

}  // namespace
}  // namespace tera
