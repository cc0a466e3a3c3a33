#include "sim/carried_soil.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/units.h"
#include "soil/soil_fixture.h"

namespace tera {
namespace {

using testing_soil::CompactBucket;
using testing_soil::Shipped;

/// Mouth upwards, turned and tilted a little.
const Pose kX_WB =
    MakePose(Vec3(3, -1, 2), RotationFromRpy(0, 0, 0.7) * RotationFromRpy(0.08, kPi - 0.2, 0));

SoilReaction::Load Load(double volume_m3, std::vector<double> soil_kg) {
  SoilReaction::Load load;
  load.volume_m3 = volume_m3;
  load.soil_kg = std::move(soil_kg);
  for (const double kg : load.soil_kg) load.mass_kg += kg;
  return load;
}

TEST(CarriedSoil, IsNothingWhenTheShovelIsEmpty) {
  EXPECT_EQ(CarriedSoil(CompactBucket(), {Shipped("dirt")}).Shape(Load(0, {0}), kX_WB), nullptr);
}

TEST(CarriedSoil, HasTheColourOfTheSoilThatWasDugNotOfTheSitesFirst) {
  const std::vector<SoilType> soils = {Shipped("clay"), Shipped("sand"), Shipped("asphalt")};
  const auto shape = CarriedSoil(CompactBucket(), soils).Shape(Load(0.09, {0, 130, 0}), kX_WB);
  ASSERT_NE(shape, nullptr);
  EXPECT_LT((shape->parts[0].material.albedo - LooseAlbedo(soils[1])).norm(), 1e-12);
  for (const Eigen::Vector3f& albedo : shape->parts[0].albedos) {  // brighter or darker, one hue
    const Vec3 hue = albedo.cast<double>().normalized();
    EXPECT_LT((hue - LooseAlbedo(soils[1]).normalized()).norm(), 1e-5);
  }
}

TEST(CarriedSoil, MixesSoilsByTheirShareOfTheVolume) {
  const std::vector<SoilType> soils = {Shipped("asphalt"), Shipped("sand")};
  // A quarter of the volume is dark.
  const double dark_kg = 0.02 * LooseDensity_kgpm3(soils[0]);
  const double light_kg = 0.06 * LooseDensity_kgpm3(soils[1]);
  const auto shape =
      CarriedSoil(CompactBucket(), soils).Shape(Load(0.08, {dark_kg, light_kg}), kX_WB);
  ASSERT_NE(shape, nullptr);
  const Vec3 mixed = 0.25 * LooseAlbedo(soils[0]) + 0.75 * LooseAlbedo(soils[1]);
  EXPECT_LT((shape->parts[0].material.albedo - mixed).norm(), 1e-9);
  Vec3 mean = Vec3::Zero();
  const auto& albedos = shape->parts[0].albedos;
  for (const Eigen::Vector3f& albedo : albedos) mean += albedo.cast<double>() / albedos.size();
  // Some 1300 grains. A quarter of their colour is either soil's, with a deviation of 0.43 of the
  // difference, and their brightness varies by 0.09. Five standard errors are 2 %; border points
  // count more often, because of the skirt.
  EXPECT_LT((mean - mixed).cwiseAbs().maxCoeff(), 0.03 * mixed.maxCoeff());
}

TEST(CarriedSoil, BoxHoldsTheHeapAsItLiesAndNoMore) {
  const CarriedSoil soil(CompactBucket(), {Shipped("dirt")});
  const auto little = soil.Shape(Load(0.01, {15}), kX_WB);
  const auto much = soil.Shape(Load(0.11, {150}), kX_WB);
  ASSERT_TRUE(little && much);
  for (const auto& shape : {little, much}) {
    for (const Eigen::Vector3f& p_B_m : shape->parts[0].positions_m) {
      for (int k = 0; k < 3; ++k) {
        EXPECT_GE(p_B_m[k], shape->box_min_B_m[k] - 1e-6);
        EXPECT_LE(p_B_m[k], shape->box_max_B_m[k] + 1e-6);
      }
    }
    EXPECT_NEAR(shape->box_max_B_m.z(), 0.42, 0.03);  // the shell's lowest point
  }
  EXPECT_LT(little->box_max_B_m.z() - little->box_min_B_m.z(), 0.25);
  EXPECT_GT(much->box_max_B_m.z() - much->box_min_B_m.z(), 0.40);
}

TEST(CarriedSoil, SameLoadInTheSamePositionLooksTheSame) {
  const CarriedSoil soil(CompactBucket(), {Shipped("dirt")});
  const auto a = soil.Shape(Load(0.05, {70}), kX_WB), b = soil.Shape(Load(0.05, {70}), kX_WB);
  const auto more = soil.Shape(Load(0.06, {84}), kX_WB);
  EXPECT_TRUE(AreAlike(a.get(), b.get()));
  EXPECT_FALSE(AreAlike(a.get(), more.get()));
  EXPECT_FALSE(AreAlike(a.get(), nullptr));
  // Rotated about the vertical it keeps its shape, tilted it does not.
  const Pose turned = MakePose(Vec3(1, 0, 0), RotationFromRpy(0, 0, 0.5)) * kX_WB;
  const Pose tilted = kX_WB * MakePose(Vec3::Zero(), RotationFromRpy(0, 0.1, 0));
  const auto again = soil.Shape(Load(0.05, {70}), turned);
  EXPECT_LT((a->box_min_B_m - again->box_min_B_m).norm(), 1e-6);
  EXPECT_LT((a->box_max_B_m - again->box_max_B_m).norm(), 1e-6);
  EXPECT_FALSE(AreAlike(a.get(), soil.Shape(Load(0.05, {70}), tilted).get()));
}

}  // namespace
}  // namespace tera
