#include "soil/tool/shovel_shape.h"

#include <gtest/gtest.h>

#include <cmath>

#include "soil/soil_fixture.h"

namespace tera {
namespace {

using namespace testing_soil;

TEST(ShovelShape, VerticalLineCrossesTheTurnedBucketWhereItsCornersAre) {
  const ShovelShape shape(CompactBucket());
  // Mouth upwards (pitch 180 deg), yawed and lifted: the bottom of the shell, at z_B = 0.42, is the
  // lowest point under x_B = 0.30.
  const Pose X_WB =
      MakePose(Vec3(1, 2, 3), RotationFromRpy(0, 0, 0.7) * RotationFromRpy(0, kPi, 0));
  const Vec3 p_W = X_WB * Vec3(0.30, 0.1, 0.42);
  const ShovelShape::Uprights uprights(shape, X_WB);
  const auto crossing = shape.VerticalCrossing(uprights.At(p_W.x(), p_W.y()));
  ASSERT_TRUE(crossing);
  EXPECT_NEAR(crossing->low_m, 3 - 0.42, 1e-9);
  EXPECT_FALSE(crossing->through_mouth);
  // The mouth runs from z_B = -0.03 at x_B = 0.09 to 0 at 0.78.
  EXPECT_NEAR(crossing->high_m, 3 + 0.03 * (0.78 - 0.30) / 0.69, 1e-9);
  const Vec3 beside_W = X_WB * Vec3(0.30, 0.31, 0);
  EXPECT_FALSE(shape.VerticalCrossing(uprights.At(beside_W.x(), beside_W.y())));
}

TEST(ShovelShape, HoldsItsStruckVolumeLevelAndNothingUpsideDown) {
  const ShovelShape shape(CompactBucket());
  const Vec3 mouth = shape.LevelUp_B();
  // Repose 0 (a liquid) in a level bucket: the struck capacity. The slices resolve it to 1 %.
  EXPECT_NEAR(shape.HoldFor(mouth, 0, 1).volume_m3, 0.11, 0.0011);
  EXPECT_GT(shape.HoldFor(mouth, 35 * kDeg, 1).volume_m3, 0.12);  // heaped
  EXPECT_EQ(shape.HoldFor(-mouth, 35 * kDeg, 1).volume_m3, 0);
  // A level fill's centre lies inside, below the mouth.
  const Vec3 com = shape.HoldFor(mouth, 0, 0.05).com_B_m;
  EXPECT_GT(com.z(), 0.15);
  EXPECT_LT(com.z(), 0.42);
}

/// A box as wide as it is long, 0.5 m deep, open above.
Shovel OpenBox() {
  Shovel box;
  box.profile_B_m = {{1, 0}, {1, -0.5}, {0, -0.5}, {0, 0}};
  box.width_m = 1;
  box.capacity_m3 = 0.5;
  return box;
}

TEST(ShovelShape, HeapsAPyramidOverASquareMouth) {
  // Four faces at 45 degrees meet 0.5 m above the middle: a third of 1 x 1 x 0.5 m. Slices that are
  // level lengthwise resolve it as a hip roof; the pyramid's two other faces are exact.
  const double heap_m3 =
      ShovelShape(OpenBox()).HoldFor(Vec3::UnitZ(), 45 * kDeg, 9).volume_m3 - 0.5;
  EXPECT_NEAR(heap_m3, 1.0 / 6, 0.003);
}

TEST(ShovelShape, TiltedSidewaysLosesWhatRisesAboveItsLowerSideWall) {
  const ShovelShape shape(OpenBox());
  // Without friction the surface falls from the lower wall's top by the tilt: at 20 deg a wedge
  // of tan(20 deg) / 2 is missing.
  const Vec3 up_B(0, std::sin(20 * kDeg), std::cos(20 * kDeg));
  EXPECT_NEAR(shape.HoldFor(up_B, 1e-6, 9).volume_m3, 0.5 - 0.5 * std::tan(20 * kDeg), 0.003);
  // Soil at 45 deg keeps more; tilted by as much as that, its surface is level with the wall's top.
  EXPECT_GT(shape.HoldFor(up_B, 45 * kDeg, 9).volume_m3, 0.5);
  EXPECT_NEAR(shape.HoldFor(Vec3(0, 1, 1), 45 * kDeg, 9).volume_m3, 0.5, 0.003);
}

TEST(ShovelShape, TiltedBeyondReposeHoldsWhatLiesUnderReposeFromItsLip) {
  // Tilted by 57 deg, soil at 37 deg falls into the box by 20 deg from the lip: a wedge of
  // tan(20 deg) / 2 is missing.
  const Vec3 up_B(std::sin(57 * kDeg), 0, std::cos(57 * kDeg));
  EXPECT_NEAR(ShovelShape(OpenBox()).HoldFor(up_B, 37 * kDeg, 9).volume_m3,
              0.5 - 0.5 * std::tan(20 * kDeg), 0.003);
}

TEST(ShovelShape, SoilUnderASlopingPlaneHasItsCentreBelowThePlanesHighSide) {
  // Half the box below a plane of 1 in 5: 0.15 to 0.35 m deep over 1 m. About its middle the
  // trapezium's moment is 0.2 / 12, over an area of 0.25; its height is the mean of h^2 / 2.
  const Vec3 com_B = ShovelShape(OpenBox())
                         .HoldFor(Vec3::UnitZ(), 37 * kDeg, 0.25, Vec3(-0.2, 0, 1).normalized())
                         .com_B_m;
  EXPECT_NEAR(com_B.x(), 0.5 + 0.2 / 12 / 0.25, 1e-3);
  EXPECT_NEAR(com_B.z(), -0.5 + (0.25 * 0.25 + 0.2 * 0.2 / 12) / 2 / 0.25, 1e-3);
}

TEST(ShovelShape, TeethHoldNothing) {
  Shovel toothed = OpenBox();
  toothed.teeth = 4;
  toothed.tooth_length_m = 0.2;
  // Liquid in the level box reaches the edge 0.2 m below the tips; struck from edge to top edge it
  // would be the capacity.
  const ShovelShape shape(toothed);
  EXPECT_NEAR(shape.HoldFor(shape.LevelUp_B(), 1e-6, 9).volume_m3, 0.5, 0.01);
  EXPECT_NEAR(shape.HoldFor(Vec3::UnitZ(), 1e-6, 9).volume_m3, 0.5 * 0.3 / 0.4, 0.01);
  EXPECT_NEAR(shape.LowerLip_B(Vec3::UnitZ()).z(), -0.2, 1e-12);
}

}  // namespace
}  // namespace tera
