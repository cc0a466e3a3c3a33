#include "blind/plant/plant.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "blind/plant/axis_equations.h"
#include "blind/plant/integrator.h"

namespace tera::blind {
namespace {

constexpr double kDeg = std::numbers::pi / 180;
constexpr std::size_t kSlew = 0, kBoom = 1, kArm = 2, kBucket = 3;

const Excavator& Tb235() {
  static const Excavator excavator = Excavator::Read("config/machines/tb235.yaml");
  return excavator;
}

AxisValues Folded() { return {0, 30 * kDeg, -90 * kDeg, -10 * kDeg}; }

std::vector<double> Every10ms(double duration_s) {
  std::vector<double> times;
  for (double t_s = 0.005; t_s < duration_s - 0.01; t_s += 0.01) times.push_back(t_s);
  return times;
}

/// One joint under a lever over time, the others at rest.
Motion Driven(std::size_t axis, const AxisForm& form, double duration_s,
              const std::function<double(double)>& lever, const AxisValues& start_rad = Folded()) {
  Forms forms{};
  forms[axis] = form;
  return Move(
      Tb235(), forms, {start_rad, duration_s, Every10ms(duration_s)},
      [&](double t_s, const AxisValues&) {
        AxisValues levers{};
        levers[axis] = lever(t_s);
        return levers;
      },
      Stream(1, "test"));
}

double At(const Motion& motion, std::size_t axis, double t_s) {
  std::size_t k = 0;
  while (k + 1 < motion.t_s.size() && motion.t_s[k] < t_s) ++k;
  return motion.w_radps[k][axis];
}

TEST(Integrator, FollowsADecayAndStopsAtItsEdge) {
  // x' = -1 while x > 0, then x' = -2: at t = 2 from x = 1 it is -2.
  int crossed = 0;
  Integrator integrator(
      {1.0}, [](double, auto x, auto dx) { dx[0] = x[0] > 0 ? -1 : -2; }, 1,
      [&](double, auto x, auto edges) { edges[0] = x[0], crossed += x[0] < 0; });
  EXPECT_NEAR(integrator.To(2)[0], -2, 1e-5);
  Integrator decay(
      {1.0}, [](double, auto x, auto dx) { dx[0] = -x[0]; }, 0, nullptr);
  EXPECT_NEAR(decay.To(1)[0], std::exp(-1), 1e-5);
}

TEST(Excavator, BearsWhatHangsBeyondAJointByItsMassAndArm) {
  // Bucket axis level with the undercarriage: absolute pitch boom + arm + bucket - 45 deg = 0, so
  // that the bucket's centre of mass is 0.32 m ahead of its pin (com_m x) and 124.9 kg.
  const AxisValues level = {0.7, 30 * kDeg, -60 * kDeg, 75 * kDeg};
  EXPECT_NEAR(Tb235().Loads_nm(level)[kBucket], 124.9 * 9.80665 * 0.32, 0.5);
  EXPECT_NEAR(Tb235().Loads_nm(level)[kSlew], 0, 1e-9);
  // The gradient of the potential energy: raising the boom by 1 mrad lifts its load.
  EXPECT_GT(Tb235().Loads_nm(level)[kBoom], Tb235().Loads_nm(level)[kBucket]);
}

TEST(Excavator, TurnsEasierAboutItsSlewWithTheArmPulledIn) {
  const AxisValues out = {0, 20 * kDeg, -40 * kDeg, 0}, in = {0, 60 * kDeg, -150 * kDeg, 0};
  EXPECT_GT(Tb235().Inertias_kgm2(out)[kSlew], 1.5 * Tb235().Inertias_kgm2(in)[kSlew]);
}

TEST(Excavator, IsOffByUpToThreePerCent) {
  const Excavator off = Tb235().Off(0.03, Stream(4, "off"));
  const double ratio = off.axis(kBoom).mass_kg / Tb235().axis(kBoom).mass_kg;
  EXPECT_NE(ratio, 1);
  EXPECT_NEAR(ratio, 1, 0.03);
}

TEST(Plant, GivesTheFullRateAtFullLeverAndHoldsItsWeightAtNone) {
  const Motion motion = Driven(kBoom, {}, 1.5, [](double t_s) { return t_s < 1 ? 1 : 0; });
  EXPECT_NEAR(At(motion, kBoom, 0.9), 25.8 * kDeg, 1e-3);
  EXPECT_NEAR(At(motion, kBoom, 1.4), 0, 1e-3);
  EXPECT_NEAR(At(motion, kArm, 0.9), 0, 1e-3);
}

TEST(Plant, AnOverlappedSpoolDoesNotAnswerWithinItsOverlap) {
  AxisForm form;
  form.overlap = 0.15;
  EXPECT_NEAR(At(Driven(kArm, form, 1, [](double) { return 0.14; }), kArm, 0.9), 0, 1e-6);
  // Beyond it the opening is less by overlap and half the notch.
  EXPECT_NEAR(At(Driven(kArm, form, 1, [](double) { return 0.5; }), kArm, 0.9),
              (0.5 - 0.15 - form.notch / 2) * 43.3 * kDeg, 1e-3);
}

/// Delay of a step response: the area between step and response, over its height.
double Lateness_s(const AxisForm& form) {
  const Motion motion = Driven(kBucket, form, 1.6, [](double) { return 0.5; });
  double late_s = 0;
  for (const AxisValues& w : motion.w_radps)
    late_s += 0.01 * (1 - w[kBucket] / (0.5 * 43.3 * kDeg));
  return late_s;
}

TEST(Plant, LineQueueAndLagsAreLateByTheirSum) {
  const double without_s = Lateness_s({});
  AxisForm line, queue, lag;
  line.line_stages = 24, line.line_s = 0.2;
  queue.queue_s = 0.2;
  lag.lag_s = 0.2;
  EXPECT_NEAR(Lateness_s(line) - without_s, 0.2, 0.005);
  EXPECT_NEAR(Lateness_s(queue) - without_s, 0.2, 0.005);
  EXPECT_NEAR(Lateness_s(lag) - without_s, 0.2, 0.005);
}

TEST(Plant, AGapIsLostAtEveryReversal) {
  AxisForm form;
  form.gap_rad = 0.04;
  const auto there_and_back = [](double t_s) { return t_s < 1 ? 0.5 : (t_s < 2 ? -0.5 : 0); };
  const Motion motion = Driven(kBucket, form, 3, there_and_back);
  const double turned_rad = motion.q_rad[190][kBucket] - motion.q_rad[95][kBucket];
  const double drive_rad =
      0.5 * kDeg * (43.3 * (1 - motion.t_s[95]) - 64.3 * (motion.t_s[190] - 1));
  // Half of the play on the way out, all of it on the way back.
  EXPECT_NEAR(turned_rad - drive_rad, Play_rad(form), 0.0005);
  EXPECT_NEAR(Play_rad(form), 0.0483, 0.0001);
}

TEST(Plant, AMassOnASpringSwingsAtItsFrequency) {
  AxisForm form;
  form.flex_radps = 10, form.flex_damping = 0.05;
  const Motion motion = Driven(kArm, form, 3, [](double) { return 0.4; });
  // Peaks are a period apart: 2 pi / 10 s.
  std::vector<double> peaks_s;
  for (std::size_t k = 1; k + 1 < motion.t_s.size(); ++k) {
    const auto w = [&](std::size_t i) { return motion.w_radps[i][kArm]; };
    if (w(k) > w(k - 1) && w(k) >= w(k + 1) && w(k) > 0.42 * 43.3 * kDeg) {
      peaks_s.push_back(motion.t_s[k]);
    }
  }
  ASSERT_GE(peaks_s.size(), 2u);
  EXPECT_NEAR(peaks_s[1] - peaks_s[0], 2 * std::numbers::pi / 10, 0.03);
}

TEST(Plant, FrictionTakesItsRateFromAWeakDrive) {
  // Steady: the drive lags by friction over its damping I / T, and stiction holds up to 1 / 0.6 of
  // that.
  AxisForm form;
  const double lost_radps = 0.05;
  form.bristle_nm =
      lost_radps / (form.sliding_share * form.weak_s) * Tb235().Inertias_kgm2(Folded())[kArm];
  const double full_radps = 43.3 * kDeg;
  EXPECT_NEAR(At(Driven(kArm, form, 1.5, [](double) { return 0.4; }), kArm, 1.0),
              0.4 * full_radps - lost_radps, 0.003);
  const double held = 0.95 * lost_radps / form.sliding_share / full_radps;
  EXPECT_NEAR(At(Driven(kArm, form, 1.5, [&](double) { return held; }), kArm, 1.4), 0, 1e-3);
}

TEST(Plant, AHeldSpoolStaysBehindTheLeverBothWays) {
  AxisForm form;
  form.spool_play = 0.2;
  const auto up_and_back = [](double t_s) { return t_s < 1 ? 0.6 : t_s < 2 ? 0.3 : 0; };
  const Motion motion = Driven(kArm, form, 3, up_and_back);
  EXPECT_NEAR(At(motion, kArm, 0.9), 0.5 * 43.3 * kDeg, 1e-3);
  EXPECT_NEAR(At(motion, kArm, 1.9), 0.4 * 43.3 * kDeg, 1e-3);
  EXPECT_NEAR(At(motion, kArm, 2.9), 0, 1e-3);
}

TEST(Plant, OilUnderLoadGoesSlowerUpThanDown) {
  AxisForm form;
  form.supply_nm = 3 * std::abs(Tb235().Loads_nm(Folded())[kBoom]);
  const double up = At(Driven(kBoom, form, 1, [](double) { return 0.3; }), kBoom, 0.9);
  const double down = At(Driven(kBoom, form, 1, [](double) { return -0.3; }), kBoom, 0.9);
  // Orifice: sqrt(1 - 1/3) of the nominal rate up, sqrt(1 + 1/3) down, where nominal rates hold.
  EXPECT_NEAR(up / (0.3 * 25.8 * kDeg), std::sqrt(2.0 / 3), 0.03);
  EXPECT_NEAR(-down / (0.3 * 30.8 * kDeg), std::sqrt(4.0 / 3), 0.03);
}

TEST(Plant, OilUnderAnArmDrawnInGoesSlowerInThanOut) {
  // The arm hangs on the machine's side of its pin: its weight pulls it out.
  const AxisValues drawn_in = {0, 30 * kDeg, -140 * kDeg, -10 * kDeg};
  const double load_nm = Tb235().Loads_nm(drawn_in)[kArm];
  ASSERT_LT(load_nm, -500);
  AxisForm form;
  form.supply_nm = -3 * load_nm;
  const double out = At(Driven(
                            kArm, form, 0.5, [](double) { return 0.1; }, drawn_in),
                        kArm, 0.4);
  const double in = At(Driven(
                           kArm, form, 0.5, [](double) { return -0.1; }, drawn_in),
                       kArm, 0.4);
  EXPECT_NEAR(out / (0.1 * 43.3 * kDeg), std::sqrt(4.0 / 3), 0.03);
  EXPECT_NEAR(-in / (0.1 * 42.7 * kDeg), std::sqrt(2.0 / 3), 0.03);
}

TEST(Plant, GivesTheSameAgainUnderTheSameLevers) {
  const Motion once = Driven(kArm, {}, 2, [](double t_s) { return 0.4 * std::sin(3 * t_s); });
  const Motion again =
      Move(Tb235(), Forms{}, {Folded(), 2, Every10ms(2)}, Replayed(once), Stream(1, "test"));
  EXPECT_EQ(once.w_radps, again.w_radps);
}

}  // namespace
}  // namespace tera::blind
