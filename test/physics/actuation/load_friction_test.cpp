#include "physics/actuation/load_friction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "physics/actuation/slot_fixture.h"

namespace tera {
namespace {

constexpr double kLoadFrictionStep_s = 0.002;

LoadFriction LoadFrom(const std::string& yaml, double max_effort_nm = 5000) {
  return LoadFriction(LoadFrictionOf(EffectsFrom(yaml), ActuatorEffort::Constant(max_effort_nm)));
}

TEST(LoadFriction, WithoutEffectsIsThePassThrough) {
  LoadFriction load = LoadFrom("{}");
  for (int i = 0; i < 100; ++i) {
    EXPECT_EQ(load.Step(std::sin(i), 1e6 * std::cos(i), 0, kLoadFrictionStep_s), std::sin(i));
  }
  EXPECT_FALSE(load.Friction(0.3).any());
}

TEST(LoadFriction, ALoadSlowsTheActuatorByTheOrificeLaw) {
  const std::string droop = "pressure_droop: {stall_nm: 4000, response_s: 0}";
  EXPECT_NEAR(LoadFrom(droop).Step(0.5, 3000, 0, kLoadFrictionStep_s), 0.25, 1e-12);  // sqrt(1/4)
  EXPECT_NEAR(LoadFrom(droop).Step(-0.5, -3000, 0, kLoadFrictionStep_s), -0.25, 1e-12);
  EXPECT_NEAR(LoadFrom(droop).Step(-0.5, 5000, 0, kLoadFrictionStep_s), -0.75,
              1e-12);                                                     // aided: sqrt(9/4)
  EXPECT_EQ(LoadFrom(droop).Step(0.5, 4001, 0, kLoadFrictionStep_s), 0);  // stalls
  EXPECT_EQ(LoadFrom(droop).Step(0, 3000, 0, kLoadFrictionStep_s), 0);
}

TEST(LoadFriction, FrictionAddsToTheLoadThatSlowsTheActuator) {
  LoadFriction load = LoadFrom(
      "{pressure_droop: {stall_nm: 4000, response_s: 0}, coulomb_friction: {effort_nm: 1000}}");
  EXPECT_NEAR(load.Step(0.5, 2000, 0, kLoadFrictionStep_s), 0.25, 1e-12);
  EXPECT_NEAR(load.Step(-0.5, -2000, 0, kLoadFrictionStep_s), -0.25, 1e-12);
}

TEST(LoadFriction, ViscousFrictionAddsToTheLoadThatSlowsTheActuator) {
  LoadFriction load = LoadFrom(
      "{pressure_droop: {stall_nm: 4000, response_s: 0}, viscous_friction: {coefficient_nmsprad: "
      "2000}}");
  EXPECT_NEAR(load.Step(-0.5, -2000, 0, kLoadFrictionStep_s), -0.25, 1e-12);
}

TEST(LoadFriction, PressureFollowsTheLoadWithItsResponseTime) {
  LoadFriction load = LoadFrom("pressure_droop: {stall_nm: 4000, response_s: 0.1}");
  double rate = 0;
  for (int i = 0; i < 50; ++i) rate = load.Step(1, 3000, 0, kLoadFrictionStep_s);
  // After 0.1 s the pressure shows 1 - 1/e of the load.
  EXPECT_NEAR(rate, std::sqrt(1 - 0.75 * 0.6321205588), 1e-9);
}

TEST(LoadFriction, ALeakYieldsInProportionToTheLoad) {
  const std::string sag = "sag: {drift_radps: 0.002}";
  EXPECT_NEAR(LoadFrom(sag).Step(0, 5000, 0, kLoadFrictionStep_s), -0.002, 1e-15);
  EXPECT_NEAR(LoadFrom(sag).Step(0, -2500, 0, kLoadFrictionStep_s), 0.001, 1e-15);
  EXPECT_NEAR(LoadFrom(sag).Step(0.3, 2500, 0, kLoadFrictionStep_s), 0.299, 1e-12);
}

TEST(LoadFriction, WhatFrictionHoldsDoesNotLeak) {
  const std::string both = "{sag: {drift_radps: 0.002}, coulomb_friction: {effort_nm: 1000}}";
  EXPECT_EQ(LoadFrom(both).Step(0, 900, 0, kLoadFrictionStep_s), 0);
  EXPECT_NEAR(LoadFrom(both).Step(0, 3500, 0, kLoadFrictionStep_s), -0.001, 1e-15);
  EXPECT_NEAR(LoadFrom(both).Step(0, -3500, 0, kLoadFrictionStep_s), 0.001, 1e-15);
}

TEST(LoadFriction, OilThickensInTheColdAsItsGradeDoes) {
  // ISO VG 46 (ISO 3448: 41.4 to 50.6 mm2/s at 40 C). Makers' sheets of mineral oils of this grade
  // with a viscosity index of 95 to 105 state 6.6 to 7.0 mm2/s at 100 C and 500 to 640 mm2/s at 0
  // C. The chart of ASTM D341 reads 11 mm2/s at 80 C, to 10 %.
  EXPECT_NEAR(OilViscosity_cst(40), 46, 0.1);
  EXPECT_NEAR(OilViscosity_cst(100), 6.8, 0.2);
  EXPECT_NEAR(OilViscosity_cst(80), 11, 1.1);
  EXPECT_NEAR(OilViscosity_cst(0), 570, 70);
}

TEST(LoadFriction, WarmOilLeaksFaster) {
  const double cool =
      LoadFrom("sag: {drift_radps: 0.002, oil_degc: 40}").Step(0, 5000, 0, kLoadFrictionStep_s);
  const double hot =
      LoadFrom("sag: {drift_radps: 0.002, oil_degc: 100}").Step(0, 5000, 0, kLoadFrictionStep_s);
  EXPECT_NEAR(hot / cool, 46 / 6.8, 1e-9);
}

TEST(LoadFriction, FlexRingsAtItsDampedFrequencyWithItsOvershoot) {
  // Second order, z = 0.2, w = 12: the first peak is at pi / (w sqrt(1 - z^2)) = 0.26720 s, with
  // the overshoot e^(-pi z / sqrt(1 - z^2)) = 0.52662.
  LoadFriction load = LoadFrom("structural_flex: {natural_radps: 12, damping: 0.2}");
  double peak = 0, at_s = 0, rate = 0;
  for (int i = 1; i <= 5000; ++i) {
    rate = load.Step(1, 0, 0, 0.001);
    if (i <= 500 && rate > peak) peak = rate, at_s = i * 0.001;
  }
  EXPECT_NEAR(at_s, 0.26720, 0.001);
  EXPECT_NEAR(peak, 1.52662, 1e-4);
  EXPECT_NEAR(rate, 1, 1e-4);
}

TEST(LoadFriction, FlexPassesASineAsASecondOrderFilter) {
  // At resonance the gain is 1 / (2 z).
  LoadFriction load = LoadFrom("structural_flex: {natural_radps: 12, damping: 0.1}");
  double most = 0;
  for (int i = 0; i < 10000; ++i) {
    const double y = load.Step(std::sin(12 * (i + 0.5) * 0.001), 0, 0, 0.001);
    if (i > 8000) most = std::max(most, y);
  }
  EXPECT_NEAR(most, 5, 0.01);
}

TEST(LoadFriction, FlexGivesWayToALoadAndSwingsAboutIt) {
  // A spring of 1e5 N m/rad: another 2000 N m bend it by 0.02 rad in the end. It overshoots by
  // e^(-pi z / sqrt(1 - z^2)) = 0.52662 of that, at pi / (w sqrt(1 - z^2)).
  LoadFriction load =
      LoadFrom("structural_flex: {natural_radps: 12, damping: 0.2, compliance_radpnm: 1e-5}");
  EXPECT_EQ(load.Step(0, 5000, 0, 0.001), 0);  // bent already
  double angle_rad = 0, lowest_rad = 0, at_s = 0;
  for (int i = 1; i <= 5000; ++i) {
    angle_rad += 0.001 * load.Step(0, 7000, 0, 0.001);
    if (angle_rad < lowest_rad) lowest_rad = angle_rad, at_s = i * 0.001;
  }
  EXPECT_NEAR(angle_rad, -0.02, 1e-4);
  EXPECT_NEAR(lowest_rad, -0.02 * 1.52662, 1e-4);
  EXPECT_NEAR(at_s, 0.26720, 0.002);
}

TEST(LoadFriction, DryFrictionTakesItsRateFromADriveThatGivesWay) {
  // T dw/dt = u - w - r from rest: w = (u - r) (1 - e^(-t/T)). After the lever's release it comes
  // to rest in T ln(1 + (u - r) / r).
  LoadFriction load = LoadFrom("drive_friction: {lost_radps: 0.1, time_s: 0.2}");
  double rate = 0;
  for (int i = 1; i <= 200; ++i) rate = load.Step(0.5, 0, 0, 0.001);
  EXPECT_NEAR(rate, 0.4 * (1 - std::exp(-1.0)), 1e-9);
  for (int i = 1; i <= 4000; ++i) rate = load.Step(0.5, 0, 0, 0.001);
  EXPECT_NEAR(rate, 0.4, 1e-6);
  int steps = 0;
  while (load.Step(0, 0, 0, 0.001) > 0) ++steps;
  EXPECT_NEAR(0.001 * steps, 0.2 * std::log(5.0), 0.002);
  EXPECT_EQ(load.Step(0, 0, 0, 0.001), 0);
}

TEST(LoadFriction, WhatSticksTakesMoreToBreakAway) {
  // At rest it holds up to 1.5 times the sliding loss, in either direction; in motion it is less.
  LoadFriction load = LoadFrom(
      "drive_friction: {lost_radps: 0.1, time_s: 0.05, breakaway: 1.5, stribeck_radps: 0.01}");
  for (const double u : {0.149, -0.149}) EXPECT_EQ(load.Step(u, 0, 0, 0.001), 0);
  double rate = 0;
  for (int i = 0; i < 2000; ++i) rate = load.Step(-0.17, 0, 0, 0.001);
  EXPECT_NEAR(rate, -0.07, 1e-4);
  for (int i = 0; i < 2000; ++i) rate = load.Step(-0.145, 0, 0, 0.001);
  EXPECT_NEAR(rate, -0.045, 1e-3);  // where motion would not have begun
}

TEST(LoadFriction, WithoutInertiaADriveLosesItsRateAtOnce) {
  LoadFriction load = LoadFrom(
      "drive_friction: {lost_radps: 0.1, time_s: 0, breakaway: 1.5, stribeck_radps: 0.01}");
  EXPECT_EQ(load.Step(0.149, 0, 0, 0.001), 0);
  double rate = 0;
  for (int i = 0; i < 10; ++i) rate = load.Step(0.3, 0, 0, 0.001);
  EXPECT_NEAR(rate, 0.2, 1e-9);
  EXPECT_EQ(load.Step(-0.05, 0, 0, 0.001), 0);
}

TEST(LoadFriction, FrictionIsCoulombStribeckAndViscous) {
  const LoadFriction load = LoadFrom(
      "{coulomb_friction: {effort_nm: 100}, viscous_friction: {coefficient_nmsprad: 50}, "
      "stribeck_friction: {excess_nm: 40, rate_radps: 0.02}}");
  EXPECT_NEAR(load.Friction(0).against_positive_nm, 140, 1e-12);
  // At the Stribeck rate the excess has fallen to 1/e.
  EXPECT_NEAR(load.Friction(0.02).against_positive_nm, 100 + 40 * 0.3678794412, 1e-8);
  EXPECT_NEAR(load.Friction(-2).against_negative_nm, 100, 1e-9);
  EXPECT_EQ(load.Friction(-2).viscous_nmsprad, 50);
  EXPECT_EQ(load.Friction(-2).against_negative_nm, load.Friction(2).against_positive_nm);
}

TEST(LoadFriction, ViscousFrictionIsThatOfTheOilsTemperature) {
  const LoadFriction load = LoadFrom("viscous_friction: {coefficient_nmsprad: 50, oil_degc: 100}");
  EXPECT_NEAR(load.Friction(1).viscous_nmsprad, 50 * 6.8 / 46, 1e-9);
}

TEST(LoadFriction, FrictionMayDifferByDirection) {
  const LoadFriction load = LoadFrom(
      "{coulomb_friction: {effort_nm: 100}, asymmetric_friction: {positive_nm: 30, negative_nm: "
      "10}}");
  EXPECT_EQ(load.Friction(0.1).against_positive_nm, 130);
  EXPECT_EQ(load.Friction(-0.1).against_negative_nm, 110);
}

TEST(LoadFriction, ViscousFrictionMayDifferByDirection) {
  const LoadFriction load = LoadFrom(
      "{viscous_friction: {coefficient_nmsprad: 167}, asymmetric_friction: {positive_nmsprad: 5, "
      "negative_nmsprad: 73}}");
  EXPECT_EQ(load.Friction(0.1).viscous_nmsprad, 172);
  EXPECT_EQ(load.Friction(-0.1).viscous_nmsprad, 240);
}

}  // namespace
}  // namespace tera
