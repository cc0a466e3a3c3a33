#include "physics/actuation/command_timing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "physics/actuation/slot_fixture.h"

namespace tera {
namespace {

constexpr double kCommandTimingStep_s = 0.002;

CommandTiming TimingFrom(const std::string& yaml, std::int64_t first_step = 0,
                         const std::string& stream = "m/boom/command_drops") {
  return {CommandTimingOf(EffectsFrom(yaml)), Stream(7, stream), first_step};
}

TEST(CommandTiming, WithoutEffectsIsThePassThrough) {
  CommandTiming timing = TimingFrom("{}", -31);
  for (int i = 0; i < 500; ++i) {
    const double u = std::sin(0.37 * i);
    EXPECT_EQ(timing.Step(u, kCommandTimingStep_s), u);
  }
}

TEST(CommandTiming, ADelayOfWholeStepsShiftsTheCommand) {
  CommandTiming timing = TimingFrom("command_delay: {delay_s: 0.1}");
  for (int i = 0; i < 300; ++i) {
    const double late = i < 50 ? 0 : std::sin(0.11 * (i - 50));
    EXPECT_NEAR(timing.Step(std::sin(0.11 * i), kCommandTimingStep_s), late, 1e-9);
  }
}

TEST(CommandTiming, AnyDelayKeepsWhatTheCommandSumsTo) {
  // A delayed signal has a delayed integral: under a lever that steps up at 0, the joint moves by
  // (t - d).
  for (const double delay_s : {0.0007, 0.0503, 0.25, 0.3331}) {
    CommandTiming timing = TimingFrom("command_delay: {delay_s: " + std::to_string(delay_s) + "}");
    double sum_s = 0;
    for (int i = 0; i < 500; ++i)
      sum_s += timing.Step(1, kCommandTimingStep_s) * kCommandTimingStep_s;
    EXPECT_NEAR(sum_s, 1.0 - delay_s, 1e-9) << delay_s;
  }
}

TEST(CommandTiming, ASineComesLaterByTheDelayAtAnyFraction) {
  // 1 Hz, delayed by 41.3 ms: over whole periods the first harmonic has the phase -2 pi f d.
  // Between samples 2 ms apart, linear interpolation misses the sine by at most (2 pi f dt)^2 / 8 =
  // 2e-5.
  CommandTiming timing = TimingFrom("command_delay: {delay_s: 0.0413}");
  double in_phase = 0, quadrature = 0;
  for (int i = 0; i < 1500; ++i) {
    const double t_s = i * kCommandTimingStep_s;
    const double y = timing.Step(std::sin(2 * M_PI * t_s), kCommandTimingStep_s);
    if (i < 500) continue;
    in_phase += y * std::sin(2 * M_PI * t_s);
    quadrature += y * std::cos(2 * M_PI * t_s);
  }
  EXPECT_NEAR(std::atan2(-quadrature, in_phase) / (2 * M_PI), 0.0413, 1e-5);
  EXPECT_NEAR(std::hypot(in_phase, quadrature) / 500, 1, 1e-4);
}

// Mean over delays spread evenly over w: over whole periods the phase is that of the mean delay,
// and the amplitude sin(pi f w) / (pi f w).
TEST(CommandTiming, ASpreadDelayRoundsASineByTheWidthOfItsBox) {
  constexpr double kDelay_s = 0.2, kSpread_s = 0.06, kSine_hz = 2;
  CommandTiming timing = TimingFrom("command_delay: {delay_s: 0.2, spread_s: 0.06}");
  double in_phase = 0, quadrature = 0;
  for (int i = 0; i < 1500; ++i) {
    const double phase = 2 * M_PI * kSine_hz * i * kCommandTimingStep_s;
    const double y = timing.Step(std::sin(phase), kCommandTimingStep_s);
    if (i < 500) continue;
    in_phase += y * std::sin(phase);
    quadrature += y * std::cos(phase);
  }
  const double x = M_PI * kSine_hz * std::sqrt(12) * kSpread_s;
  EXPECT_NEAR(std::hypot(in_phase, quadrature) / 500, std::sin(x) / x, 2e-4);
  double lag_rad = std::atan2(-quadrature, in_phase);
  if (lag_rad < 0) lag_rad += 2 * M_PI;
  EXPECT_NEAR(lag_rad / (2 * M_PI * kSine_hz), kDelay_s, 2e-5);
}

TEST(CommandTiming, ASpreadDelayKeepsWhatTheCommandSumsTo) {
  for (const double spread_s : {0.0013, 0.03, 0.5}) {
    CommandTiming timing =
        TimingFrom("command_delay: {delay_s: 0.1503, spread_s: " + std::to_string(spread_s) + "}");
    double sum_s = 0;
    for (int i = 0; i < 500; ++i)
      sum_s += timing.Step(1, kCommandTimingStep_s) * kCommandTimingStep_s;
    // The box is sampled at the middle of each step: an edge is exact to dt^2 / (8 w).
    const double width_s =
        std::hypot(std::sqrt(12) * std::min(spread_s, 0.08), kCommandTimingStep_s);
    EXPECT_NEAR(sum_s, 1.0 - 0.1503, kCommandTimingStep_s * kCommandTimingStep_s / (8 * width_s))
        << spread_s;
  }
}

TEST(CommandTiming, NoSpreadIsSoWideThatACommandActsBeforeItIsGiven) {
  CommandTiming timing = TimingFrom("command_delay: {delay_s: 0.05, spread_s: 0.5}");
  for (int i = 0; i < 100; ++i) EXPECT_EQ(timing.Step(0, kCommandTimingStep_s), 0);
  EXPECT_GT(timing.Step(1, kCommandTimingStep_s), 0);  // the fastest part has no delay
  for (int i = 0; i < 49; ++i) EXPECT_LT(timing.Step(1, kCommandTimingStep_s), 1);
  EXPECT_NEAR(timing.Step(1, kCommandTimingStep_s), 1, 0.021);
}

TEST(CommandTiming, AHeldCommandChangesOnceAPeriodAtItsPhase) {
  CommandTiming timing = TimingFrom("input_hold: {period_s: 0.05, phase: 0.4}", -100);
  std::vector<int> changes;
  double last = 0;
  for (int step = -100; step < 100; ++step) {
    const double y = timing.Step(step, kCommandTimingStep_s);
    if (y != last && step > -100) {
      changes.push_back(step);
      EXPECT_EQ(y, step);  // the command of that moment
    }
    last = y;
  }
  // (k + 0.4) 0.05 s = (25 k + 10) steps.
  EXPECT_EQ(changes, (std::vector<int>{-90, -65, -40, -15, 10, 35, 60, 85}));
}

TEST(CommandTiming, BeforeTheFirstNewLookTheFirstCommandOfAllStands) {
  // A recording that begins with a deflected lever: the sender sampled it earlier and holds it at
  // 0.5.
  CommandTiming timing = TimingFrom("input_hold: {period_s: 0.05, phase: 0.4}");
  for (int step = 0; step < 10; ++step)
    EXPECT_EQ(timing.Step(0.5 + 0.01 * step, kCommandTimingStep_s), 0.5);
  EXPECT_EQ(timing.Step(0.7, kCommandTimingStep_s), 0.7);  // step 10, the first look
  // A run that settles first, with neutral levers, holds neutral until the first sample after t =
  // 0.
  CommandTiming settled = TimingFrom("input_hold: {period_s: 0.05, phase: 0.4}", -750);
  for (int step = -750; step < 10; ++step) {
    EXPECT_EQ(settled.Step(step < 0 ? 0 : 0.7, kCommandTimingStep_s), 0) << step;
  }
  EXPECT_EQ(settled.Step(0.7, kCommandTimingStep_s), 0.7);
}

TEST(CommandTiming, LostMessagesLeaveTheLastCommandStanding) {
  const auto run = [](const std::string& stream) {
    CommandTiming timing =
        TimingFrom("command_drops: {period_s: 0.02, probability: 0.3}", 0, stream);
    std::vector<bool> lost;
    double last = 0;
    for (int message = 0; message < 4000; ++message) {
      const double first = timing.Step(10 * message + 1, kCommandTimingStep_s);
      lost.push_back(first != 10.0 * message + 1);
      if (lost.back()) {
        EXPECT_EQ(first, last);
      }
      for (int i = 2; i <= 10; ++i) {
        const double y = timing.Step(10 * message + i, kCommandTimingStep_s);
        EXPECT_EQ(y, lost.back() ? last : 10.0 * message + i);
      }
      if (!lost.back()) last = 10 * message + 10;
    }
    return lost;
  };
  const std::vector<bool> lost = run("m/boom/command_drops");
  const auto count = static_cast<double>(std::count(lost.begin(), lost.end(), true));
  // Binomial, n = 4000: sigma of the share is sqrt(0.3 0.7 / 4000) = 0.0072; 5 sigma.
  EXPECT_NEAR(count / 4000, 0.3, 0.036);
  EXPECT_EQ(run("m/boom/command_drops"), lost);
  EXPECT_NE(run("m/arm/command_drops"), lost);
}

TEST(CommandTiming, NoMessageIsLostAtProbabilityZeroAndAllAtOne) {
  CommandTiming none = TimingFrom("command_drops: {period_s: 0.02, probability: 0}");
  CommandTiming all = TimingFrom("command_drops: {period_s: 0.02, probability: 1}");
  for (int i = 1; i < 100; ++i) {
    EXPECT_EQ(none.Step(i, kCommandTimingStep_s), i);
    EXPECT_EQ(all.Step(i, kCommandTimingStep_s), 0);
  }
}

}  // namespace
}  // namespace tera
