#include "resimulate/motion/simulated_course.h"

#include <gtest/gtest.h>

#include "core/units.h"

namespace tera {
namespace {

TEST(SimulatedCourse, IsStraightBetweenItsStepsAndStandsBeyondThem) {
  // Two seconds, in steps of half a second, of a wheel that turns ever faster, from 1 s of the
  // recording on.
  SimulatedCourse course{.zero_ns = kNsPerSecond, .step_s = 0.5, .steps = {}};
  for (int k = 0; k <= 4; ++k) {
    course.steps.push_back(
        {{0.5 * k * k}, {1.0 * k}, MakePose(Vec3(2 * k, 1, 0), RotationFromRpy(0, 0, 0.1 * k))});
  }
  EXPECT_EQ(course.end_ns(), 3 * kNsPerSecond);
  EXPECT_DOUBLE_EQ(course.RateAt(FromSeconds(1.75), 0), 1.5);
  EXPECT_DOUBLE_EQ(course.PositionAt(FromSeconds(1.75), 0), 1.25);
  const Pose X_WB = course.PoseAt(FromSeconds(1.75));
  EXPECT_LT((X_WB.translation() - Vec3(3, 1, 0)).norm(), 1e-12);
  EXPECT_TRUE(X_WB.linear().isApprox(RotationFromRpy(0, 0, 0.15), 1e-9));
  EXPECT_DOUBLE_EQ(course.RateAt(0, 0), 0);
  EXPECT_DOUBLE_EQ(course.RateAt(9 * kNsPerSecond, 0), 4);
}

}  // namespace
}  // namespace tera
