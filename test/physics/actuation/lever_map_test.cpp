#include "physics/actuation/lever_map.h"

#include <gtest/gtest.h>

#include "physics/actuation/slot_fixture.h"

namespace tera {
namespace {

double Mapped(const std::string& yaml, double u) {
  return MapLever(LeverMapOf(EffectsFrom(yaml)), u);
}

TEST(LeverMap, WithoutEffectsIsThePassThrough) {
  for (double u = -1; u <= 1; u += 1.0 / 64) EXPECT_EQ(Mapped("{}", u), u);
}

TEST(LeverMap, ADeadBandTakesItsWidthFromTheLever) {
  const std::string band = "dead_band: {width: 0.2}";
  EXPECT_EQ(Mapped(band, 0.19), 0);
  EXPECT_EQ(Mapped(band, -0.19), 0);
  EXPECT_DOUBLE_EQ(Mapped(band, 1), 0.8);
  EXPECT_DOUBLE_EQ(Mapped(band, -0.6), -0.4);
}

TEST(LeverMap, AnAsymmetricDeadBandIsWiderToOneSide) {
  const std::string band = "dead_band: {width: 0.2, asymmetry: 0.5}";
  EXPECT_DOUBLE_EQ(Mapped(band, 1), 0.7);
  EXPECT_DOUBLE_EQ(Mapped(band, -1), -0.9);
}

TEST(LeverMap, AValveCurveKeepsTheEndsAndBendsBetween) {
  const std::string curve = "valve_curve: {exponent: 2}";
  EXPECT_DOUBLE_EQ(Mapped(curve, 1), 1);
  EXPECT_DOUBLE_EQ(Mapped(curve, -1), -1);
  EXPECT_DOUBLE_EQ(Mapped(curve, 0.5), 0.25);
  EXPECT_DOUBLE_EQ(Mapped(curve, -0.5), -0.25);
  EXPECT_EQ(Mapped(curve, 0), 0);
}

TEST(LeverMap, ASaturatedLeverGivesNoMoreThanItsLimit) {
  const std::string saturation = "lever_saturation: {limit: 0.7}";
  EXPECT_DOUBLE_EQ(Mapped(saturation, 0.95), 0.7);
  EXPECT_DOUBLE_EQ(Mapped(saturation, -1), -0.7);
  EXPECT_DOUBLE_EQ(Mapped(saturation, 0.5), 0.5);
}

TEST(LeverMap, ASaturationMayEndEarlierInOneDirection) {
  const std::string saturation = "lever_saturation: {limit: 0.6, asymmetry: 0.25}";
  EXPECT_DOUBLE_EQ(Mapped(saturation, 1), 0.75);
  EXPECT_NEAR(Mapped(saturation, -1), -0.45, 1e-15);
  EXPECT_DOUBLE_EQ(Mapped(saturation, -0.4), -0.4);
  EXPECT_DOUBLE_EQ(Mapped("lever_saturation: {limit: 0.9, asymmetry: 0.5}", 1), 1)
      << "levers end at 1";
}

TEST(LeverMap, GainsScaleOneDirectionOrBoth) {
  EXPECT_DOUBLE_EQ(Mapped("asymmetric_gain: {ratio: 1.5}", -0.4), -0.6);
  EXPECT_DOUBLE_EQ(Mapped("asymmetric_gain: {ratio: 1.5}", 0.4), 0.4);
  EXPECT_DOUBLE_EQ(Mapped("rate_gain: {gain: 0.9}", 0.5), 0.45);
  EXPECT_DOUBLE_EQ(Mapped("rate_gain: {gain: 0.9}", -0.5), -0.45);
}

TEST(LeverMap, ActsInTheOrderSaturationBandCurveGain) {
  const std::string all =
      "{lever_saturation: {limit: 0.9}, dead_band: {width: 0.1}, valve_curve: {exponent: 2}, "
      "asymmetric_gain: {ratio: 2}, rate_gain: {gain: 0.5}}";
  EXPECT_NEAR(Mapped(all, 1), 0.32, 1e-15);    // (0.9 - 0.1)^2 / 2
  EXPECT_NEAR(Mapped(all, -1), -0.64, 1e-15);  // twice that
}

}  // namespace
}  // namespace tera
