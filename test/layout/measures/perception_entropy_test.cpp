#include "layout/measures/perception_entropy.h"

#include <gtest/gtest.h>

#include <cmath>

#include "layout/sight/hull.h"
#include "layout/yard.h"

namespace tera {
namespace {

TestBox PerceptionEntropyNothing() { return {Vec3(0, 0, -0.5), Vec3(0.01, 0.01, -0.4)}; }

PersonStudy Standing() {
  PersonStudy person;
  person.postures = {{"standing", Vec3(0.3, 0.5, 1.75)}};
  person.farthest_m = 12;
  return person;
}

/// Above the machine, so that it sees a person at any place.
Viewer Camera(const Yard& yard, double per_sr) {
  return ViewerOf(ViewField::Samples::kPixels, per_sr, yard.X_WH() * MakePose(Vec3(0.2, -0.1, 4)));
}

double EntropyOf(const Yard& yard, const std::vector<Viewer>& viewers,
                 const InformationStudy& information = {}) {
  PerceptionEntropy entropy(Standing(), information, 0.2);
  const std::vector<double> hull_m = HullRadii_m(yard.X_WH(), 0, 36, yard.sighting());
  entropy.Add(yard.X_WH(), hull_m, LayoutOf(viewers), yard.sighting(), yard.ground());
  return FigureOf(entropy.Figures(), "information/perception_entropy").at.at(0);
}

TEST(PerceptionEntropy, OfOneSensorByHand) {
  // AP = 0.1 ln(e^2) + 0.2 = 0.4; sigma = 1 / 0.4 - 1 = 1.5;
  // H = 2 ln 1.5 + 1 + ln(2 pi) = 0.810930 + 1 + 1.837877.
  const double precision = PrecisionOf({0.1, 0.2}, std::exp(2.0));
  EXPECT_NEAR(precision, 0.4, 1e-12);
  EXPECT_NEAR(SigmaOf(precision), 1.5, 1e-12);
  EXPECT_NEAR(PlanarEntropy(1.5), 3.648807, 1e-6);
}

TEST(PerceptionEntropy, OfDifferentSensorsByHand) {
  // 1 / 3^2 + 1 / 4^2 = (16 + 9) / 144: sigma = 12 / 5.
  EXPECT_NEAR(FusedSigma({3, 4}), 2.4, 1e-12);
  EXPECT_NEAR(FusedSigma({7}), 7, 1e-12);
}

TEST(PerceptionEntropy, PrecisionStaysBetweenItsBounds) {
  EXPECT_EQ(PrecisionOf({0.1, 0.2}, 0), 0.001);
  EXPECT_EQ(PrecisionOf({0.1, 0.2}, 1e-9), 0.001);
  EXPECT_EQ(PrecisionOf({0.1, 0.2}, 1e9), 0.999);
  // The default of lidars: 0.152 ln 9 + 0.659 = 0.993, 0.152 ln 10 + 0.659 = 1.009.
  const PrecisionFit lidar = InformationStudy().lidar;
  EXPECT_NEAR(PrecisionOf(lidar, 9), 0.993, 5e-4);
  EXPECT_EQ(PrecisionOf(lidar, 10), 0.999);
}

TEST(PerceptionEntropy, FallsWithEverySampleMore) {
  double last_nat = 1e9;
  for (const double samples : {1.0, 3.0, 10.0, 100.0, 1000.0}) {
    const double nat = PlanarEntropy(SigmaOf(PrecisionOf(InformationStudy().camera, samples)));
    EXPECT_LT(nat, last_nat);
    last_nat = nat;
  }
  const Yard yard(PerceptionEntropyNothing());
  EXPECT_LT(EntropyOf(yard, {Camera(yard, 2e4)}), EntropyOf(yard, {Camera(yard, 1e4)}));
}

TEST(PerceptionEntropy, OfTwoEqualSensorsIsLessByTheLogarithmOfTwo) {
  // sigma / sqrt(2) each: 2 ln(1 / sqrt(2)) = -ln 2, at every place.
  const Yard yard(PerceptionEntropyNothing());
  const Viewer camera = Camera(yard, 1e4);
  EXPECT_NEAR(EntropyOf(yard, {camera, camera}), EntropyOf(yard, {camera}) - std::log(2.0), 1e-9);
}

TEST(PerceptionEntropy, OfNoSensorOrABlindOneIsThatOfTheLowestPrecision) {
  const Yard yard(PerceptionEntropyNothing());
  const double none_nat = 2 * std::log(999.0) + 1 + std::log(2 * kPi);
  EXPECT_NEAR(EntropyOf(yard, {}), none_nat, 1e-9);
  Viewer blind = Camera(yard, 0);
  EXPECT_NEAR(EntropyOf(yard, {blind, blind}), none_nat, 1e-9);
  const Viewer camera = Camera(yard, 1e4);
  EXPECT_NEAR(EntropyOf(yard, {camera, blind}), EntropyOf(yard, {camera}), 1e-12);
}

TEST(PerceptionEntropy, UsesTheStudysCoefficientsOfEachKind) {
  const Yard yard(PerceptionEntropyNothing());
  InformationStudy other;
  other.camera = {0.05, 0.2};
  const Viewer camera = Camera(yard, 1e4);
  EXPECT_GT(std::abs(EntropyOf(yard, {camera}, other) - EntropyOf(yard, {camera})), 0.01);
  Viewer lidar = camera;
  lidar.field.samples = ViewField::Samples::kPoints;
  EXPECT_EQ(EntropyOf(yard, {lidar}, other), EntropyOf(yard, {lidar}));
  other.lidar = {0.05, 0.2};
  EXPECT_GT(EntropyOf(yard, {lidar}, other), EntropyOf(yard, {lidar}));
}

}  // namespace
}  // namespace tera
