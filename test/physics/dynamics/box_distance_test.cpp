#include "physics/dynamics/box_distance.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/units.h"

namespace tera {
namespace {

constexpr double kTolerance_m = 1e-3;
const CollisionBox kCube{.X_BG = MakePose(Vec3(0, 0, 1)), .size_m = Vec3(2, 2, 2)};

TEST(BoxDistance, FromFaceToFaceOfTurnedBodies) {
  const Pose X_WA = MakePose(Vec3(3, -1, 2), 0.3, -0.2, 1.1);
  for (const double gap_m : {0.004, 0.7, 12.0}) {
    const Pose X_WB = X_WA * MakePose(Vec3(2 + gap_m, 0.5, 0.3), kPi / 2);
    EXPECT_NEAR(BoxDistance_m(kCube, X_WA, kCube, X_WB), gap_m, kTolerance_m);
  }
}

TEST(BoxDistance, FromEdgeToFace) {
  const Pose X_WA = MakePose(Vec3(0.4, 0.2, 0));
  const Pose X_WB = X_WA * MakePose(Vec3(3, 0, 0), 0, 0, kPi / 4);
  EXPECT_NEAR(BoxDistance_m(kCube, X_WA, kCube, X_WB), 3 - 1 - std::sqrt(2.0), kTolerance_m);
}

TEST(BoxDistance, FromCornerToCorner) {
  const Pose X_WA = MakePose(Vec3(-5, 3, 1));
  const Pose X_WB = X_WA * MakePose(Vec3(3, 4, 5));
  EXPECT_NEAR(BoxDistance_m(kCube, X_WA, kCube, X_WB), std::sqrt(1.0 + 4 + 9), kTolerance_m);
}

TEST(BoxDistance, IsNothingWhereBoxesOverlap) {
  const Pose X_WA = MakePose(Vec3(1, 1, 1), 0.1, 0.2, 0.3);
  EXPECT_EQ(BoxDistance_m(kCube, X_WA, kCube, X_WA * MakePose(Vec3(0.5, 0.5, 1.5))), 0);
  EXPECT_EQ(BoxDistance_m(kCube, X_WA, kCube, X_WA), 0);
}

}  // namespace
}  // namespace tera
