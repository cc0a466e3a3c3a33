#include "physics/actuation/actuator_dynamics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "physics/actuation/slot_fixture.h"

namespace tera {
namespace {

constexpr double kStep_s = 0.002;

ActuatorDynamics ActuatorFrom(const std::string& yaml) {
  ActuatorParameters parameters = ActuatorOf(EffectsFrom(yaml));
  parameters.lower_rad = -1;
  parameters.upper_rad = 2;
  parameters.max_rate_positive_radps = 0.5;
  parameters.max_rate_negative_radps = 0.8;
  return ActuatorDynamics(parameters);
}

/// Rates after each step of a command of 1 from rest, at position 0.
std::vector<double> StepResponse(const std::string& yaml, int steps, double dt_s = kStep_s) {
  ActuatorDynamics actuator = ActuatorFrom(yaml);
  std::vector<double> rates;
  for (int i = 0; i < steps; ++i) rates.push_back(actuator.Step(1, 0, dt_s));
  return rates;
}

TEST(ActuatorDynamics, WithoutEffectsIsThePassThrough) {
  ActuatorDynamics actuator = ActuatorFrom("{}");
  for (int i = 0; i < 200; ++i) {
    EXPECT_EQ(actuator.Step(std::sin(i), 5 - i, kStep_s), std::sin(i));
  }
}

TEST(ActuatorDynamics, ALagReaches63PercentAfterItsTimeWhateverTheStep) {
  for (const double dt_s : {0.0005, 0.002, 0.05}) {
    const int steps = static_cast<int>(std::lround(0.3 / dt_s));
    const auto rates = StepResponse("actuator_lag: {time_s: 0.3}", 3 * steps, dt_s);
    EXPECT_NEAR(rates[steps - 1], 0.6321205588, 1e-9);
    EXPECT_NEAR(rates[3 * steps - 1], 0.9502129316, 1e-9);
  }
}

TEST(ActuatorDynamics, ALagAttenuatesASineAsAFirstOrderFilter) {
  // At w T = 1 the amplitude is 1/sqrt(2).
  ActuatorDynamics actuator = ActuatorFrom("actuator_lag: {time_s: 0.25}");
  double most = 0;
  for (int i = 0; i < 5000; ++i) {
    const double y = actuator.Step(std::sin(4 * (i + 0.5) * kStep_s), 0, kStep_s);
    if (i > 2500) most = std::max(most, y);
  }
  EXPECT_NEAR(most, std::sqrt(0.5), 1e-4);
}

TEST(ActuatorDynamics, APilotBeforeALagIsASecondOne) {
  // 1 - (T e^(-t/T) - P e^(-t/P)) / (T - P) at T = 0.3, P = 0.1, t = 0.2; t = 0.6.
  for (const double dt_s : {0.0005, 0.002, 0.05}) {
    const auto at = [&](double t_s) {
      return static_cast<std::size_t>(std::lround(t_s / dt_s)) - 1;
    };
    const auto rates =
        StepResponse("actuator_lag: {time_s: 0.3, pilot_ratio: 0.33333333333333333}", 2000, dt_s);
    EXPECT_NEAR(rates[at(0.2)], 0.2975419631, 1e-9);
    EXPECT_NEAR(rates[at(0.6)], 0.7982364512, 1e-9);
    // Equal time constants: 1 - (1 + t / T) e^(-t / T).
    const auto equal = StepResponse("actuator_lag: {time_s: 0.3, pilot_ratio: 1}", 2000, dt_s);
    EXPECT_NEAR(equal[at(0.3)], 0.2642411177, 1e-9);
  }
}

TEST(ActuatorDynamics, ARateLimitWithABandEndsAsALag) {
  // Linear at 4 rad/s^2 until 4 * 0.1 = 0.4 remain of 1, at 0.15 s; then 0.4 e^(-(t - 0.15) / 0.1).
  for (const double dt_s : {0.0005, 0.04}) {  // 0.15 s is within a step of the second
    for (const double sign : {1.0, -1.0}) {
      ActuatorDynamics actuator = ActuatorFrom("rate_limit: {max_change_radps2: 4, band_s: 0.1}");
      const int steps = static_cast<int>(std::lround(0.4 / dt_s));
      for (int i = 1; i <= steps; ++i) {
        const double t_s = i * dt_s, rate = actuator.Step(sign, 0, dt_s);
        const double left = t_s < 0.15 ? 1 - 4 * t_s : 0.4 * std::exp(-(t_s - 0.15) / 0.1);
        EXPECT_NEAR(rate, sign * (1 - left), 1e-9) << t_s;
      }
    }
  }
}

TEST(ActuatorDynamics, ARateLimitRampsUpAndDown) {
  ActuatorDynamics actuator = ActuatorFrom("rate_limit: {max_change_radps2: 4}");
  for (int i = 1; i <= 100; ++i)
    EXPECT_NEAR(actuator.Step(0.6, 0, kStep_s), 0.008 * i < 0.6 ? 0.008 * i : 0.6, 1e-12);
  for (int i = 1; i <= 100; ++i) {
    EXPECT_NEAR(actuator.Step(-0.2, 0, kStep_s), std::max(-0.2, 0.6 - 0.008 * i), 1e-12);
  }
}

TEST(ActuatorDynamics, ARingIsThePapersLaw) {
  // Eq. (1) with eta 20, beta 6, phi 0: 1 + sin(20 t) e^(-6 t).
  const auto rates = StepResponse("actuator_ring: {eta_radps: 20, beta_1ps: 6, phi_rad: 0}", 500);
  EXPECT_NEAR(rates[24], 1.6233770377, 1e-9);   // 0.05 s
  EXPECT_NEAR(rates[99], 0.7720554689, 1e-9);   // 0.20 s
  EXPECT_NEAR(rates[499], 1.0022629650, 1e-9);  // 1.00 s
  // With phi = -pi/2 from rest: 1 - cos(20 t) e^(-6 t), at 0.05 s 1 - 0.5403023 0.7408182.
  const auto soft =
      StepResponse("actuator_ring: {eta_radps: 20, beta_1ps: 6, phi_rad: -1.5707963267948966}", 25);
  EXPECT_NEAR(soft[24], 0.5997342, 1e-6);
}

TEST(ActuatorDynamics, StepsOfACommandSuperposeAndEndAtRest) {
  const std::string ring = "actuator_ring: {eta_radps: 20, beta_1ps: 6, phi_rad: 0.3}";
  ActuatorDynamics twice = ActuatorFrom(ring), first = ActuatorFrom(ring),
                   second = ActuatorFrom(ring);
  for (int i = 0; i < 2000; ++i) {
    const double a = i < 700 ? 0.4 : 0.0, b = i >= 150 && i < 400 ? -0.7 : 0.0;
    const double sum = first.Step(a, 0, kStep_s) + second.Step(b, 0, kStep_s);
    EXPECT_NEAR(twice.Step(a + b, 0, kStep_s), sum, 1e-12);
  }
  // 2.6 s after the last step the ringing has decayed to e^(-15.6).
  EXPECT_NEAR(twice.Step(0, 0, kStep_s), 0, 1e-6);
}

TEST(ActuatorDynamics, ACushionSlowsTheApproachToAStopAndNotTheWayBack) {
  ActuatorDynamics actuator = ActuatorFrom("end_cushion: {zone_rad: 0.2, end_ratio: 0.1}");
  EXPECT_EQ(actuator.Step(0.5, 1.7, kStep_s), 0.5);                // outside
  EXPECT_NEAR(actuator.Step(0.5, 1.9, kStep_s), 0.275, 1e-12);     // half way: 0.55 of 0.5
  EXPECT_NEAR(actuator.Step(0.5, 2.0, kStep_s), 0.05, 1e-12);      // at the stop
  EXPECT_NEAR(actuator.Step(0.02, 2.0, kStep_s), 0.02, 1e-12);     // slow enough
  EXPECT_EQ(actuator.Step(-0.8, 2.0, kStep_s), -0.8);              // away from it
  EXPECT_NEAR(actuator.Step(-0.8, -0.95, kStep_s), -0.26, 1e-12);  // (0.1 + 0.9 / 4) 0.8
}

}  // namespace
}  // namespace tera
