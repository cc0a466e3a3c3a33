#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/units.h"
#include "sensors/encoder/encoder_slots.h"
#include "sensors/slots/given_effects.h"

namespace tera {
namespace {

using testing::Given;

/// A boom that turns and a stick that slides.
EncoderSample AxesReported(const std::string& effects, std::vector<double> q,
                           std::vector<double> qd, double t_s = 0,
                           const std::string& of_stick = "{}") {
  EncoderSlots slots(Given(EffectTarget::kEncoder, effects),
                     {{}, Given(EffectTarget::kEncoderAxis, of_stick)}, {false, true},
                     {"boom", "stick"}, 3, "m/e");
  EncoderSample sample{FromSeconds(t_s), 0, std::move(q), std::move(qd)};
  slots.Apply(&sample);
  return sample;
}

TEST(EncoderErrors, OfEncodersTakeDegreesForAnglesAndMetresForTravel) {
  EncoderSample sample = AxesReported(
      "{bias: {angle_deg: 90, rate_degps: 180, travel_m: 0.5, "
      "speed_mps: -1}}",
      {1, 1}, {1, 1});
  EXPECT_NEAR(sample.q_rad[0], 1 + kPi / 2, 1e-12);
  EXPECT_NEAR(sample.q_rad[1], 1.5, 1e-12);
  EXPECT_NEAR(sample.qd_radps[0], 1 + kPi, 1e-12);
  EXPECT_NEAR(sample.qd_radps[1], 0, 1e-12);

  sample = AxesReported(
      "{saturation: {angle_limit_deg: 90, rate_limit_degps: 180, travel_limit_m: 2, "
      "speed_limit_mps: 0.5}}",
      {-7, 7}, {-7, -7});
  EXPECT_NEAR(sample.q_rad[0], -kPi / 2, 1e-12);
  EXPECT_NEAR(sample.q_rad[1], 2, 1e-12);
  EXPECT_NEAR(sample.qd_radps[0], -kPi, 1e-12);
  EXPECT_NEAR(sample.qd_radps[1], -0.5, 1e-12);

  sample = AxesReported(
      "{quantisation: {angle_step_deg: 45, rate_step_degps: 90, travel_step_m: 0.25, "
      "speed_step_mps: 0.1}}",
      {1.6, 0.9}, {-1.5, 0.234});
  EXPECT_NEAR(sample.q_rad[0], kPi / 2, 1e-12);
  EXPECT_NEAR(sample.q_rad[1], 1, 1e-12);
  EXPECT_NEAR(sample.qd_radps[0], -kPi / 2, 1e-12);
  EXPECT_NEAR(sample.qd_radps[1], 0.2, 1e-12);

  sample = AxesReported(
      "{temperature_drift: {warm_up_k: 20, time_constant_s: 100, angle_degpk: 0.05, "
      "travel_mpk: 0.001}}",
      {0, 0}, {0, 0}, 1e5);
  EXPECT_NEAR(sample.q_rad[0], kDeg, 1e-9);
  EXPECT_NEAR(sample.q_rad[1], 0.02, 1e-9);
  sample = AxesReported("{scale: {position_factor: 1.5, rate_factor: 0.5}}", {2, -2}, {2, -2});
  EXPECT_EQ(sample.q_rad, (std::vector<double>{3, -3}));
  EXPECT_EQ(sample.qd_radps, (std::vector<double>{1, -1}));
}

TEST(EncoderErrors, OfOneAxisLieOverThoseOfTheWholeSet) {
  const EncoderSample sample = AxesReported("{scale: {position_factor: 1.5}, bias: {travel_m: 1}}",
                                            {2, 2}, {1, 1}, 0, "{scale: {rate_factor: 0.5}}");
  EXPECT_EQ(sample.q_rad, (std::vector<double>{3, 3}));
  EXPECT_EQ(sample.qd_radps, (std::vector<double>{1, 0.5}));
}

TEST(EncoderErrors, OutliersOfEncodersComeOnEachAxisByItself) {
  EncoderSlots slots(
      Given(EffectTarget::kEncoder, "{outliers: {probability: 0.2, angle_deg: 10, travel_m: 0.5}}"),
      {}, {false, true}, {"boom", "stick"}, 3, "m/e");
  const int n = 10000;
  int boom = 0, stick = 0, both = 0;
  double boom_squares = 0, stick_squares = 0;
  for (int k = 0; k < n; ++k) {
    EncoderSample sample{TimeNs{k} * 10'000'000, 0, {1, 1}, {0, 0}};
    slots.Apply(&sample);
    const double e = (sample.q_rad[0] - 1) / kDeg, f = sample.q_rad[1] - 1;
    boom += e != 0;
    stick += f != 0;
    both += e != 0 && f != 0;
    boom_squares += e * e;
    stick_squares += f * f;
  }
  // Five standard errors: 5 sqrt(0.2 * 0.8 / 10000), 5 sqrt(0.04 * 0.96 / 10000), 5 / sqrt(4000).
  EXPECT_NEAR(static_cast<double>(boom) / n, 0.2, 0.02);
  EXPECT_NEAR(static_cast<double>(stick) / n, 0.2, 0.02);
  EXPECT_NEAR(static_cast<double>(both) / n, 0.04, 0.01);
  EXPECT_NEAR(std::sqrt(boom_squares / boom), 10, 0.8);
  EXPECT_NEAR(std::sqrt(stick_squares / stick), 0.5, 0.04);
}

}  // namespace
}  // namespace tera
