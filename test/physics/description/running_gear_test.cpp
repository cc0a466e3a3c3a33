#include "physics/description/running_gear.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/units.h"

namespace tera {
namespace {

const TrackShape kTrack{
    .center_B_m = Vec3(0.1, 0.5, 0.3), .wheelbase_m = 1.6, .radius_m = 0.25, .width_m = 0.3};

TEST(RunningGear, TheBottomRunCoversTheWheelbaseOnce) {
  double length_m = 0;
  for (const ContactPatch& patch : TrackPatches(kTrack)) {
    EXPECT_EQ(patch.width_m, 0.3);
    EXPECT_EQ(patch.p_B_m.y(), 0.5);
    if (patch.outward_B.z() > -0.9999) continue;
    EXPECT_NEAR(patch.p_B_m.z(), 0.05, 1e-12);
    EXPECT_TRUE(patch.travel_B.isApprox(-Vec3::UnitX()));
    EXPECT_LE(std::abs(patch.p_B_m.x() - 0.1) + 0.5 * patch.length_m, 0.8 + 1e-12);
    length_m += patch.length_m;
  }
  EXPECT_NEAR(length_m, 1.6, 1e-12);
}

TEST(RunningGear, RoadWheelsStandEvenlyAboutTheMiddleOfTheBottomRun) {
  TrackShape track = kTrack;
  track.road_wheels = 3;
  track.road_wheel_pitch_m = 0.4;  // axles at x = -0.3, 0.1, 0.5; the run from -0.5 to 0.7
  double under_wheels_m = 0, length_m = 0;
  for (const ContactPatch& patch : TrackPatches(track)) {
    if (patch.outward_B.z() > -0.9999) continue;
    length_m += patch.length_m;
    if (patch.wheel_pitch_m == 0) {
      EXPECT_GE(std::abs(patch.p_B_m.x() - 0.1) - 0.5 * patch.length_m, 0.6 - 1e-12);
      continue;
    }
    EXPECT_EQ(patch.wheel_pitch_m, 0.4);
    under_wheels_m += patch.length_m;
    // Travel is backwards: an axle is this far ahead of the patch.
    const double axle_x_m = patch.p_B_m.x() + patch.past_wheel_m;
    EXPECT_NEAR(std::remainder(axle_x_m - 0.1, 0.4), 0, 1e-12);
    EXPECT_LE(std::abs(patch.past_wheel_m), 0.2 + 1e-12);
  }
  EXPECT_NEAR(under_wheels_m, 1.2, 1e-12);
  EXPECT_NEAR(length_m, 1.6, 1e-12);
}

TEST(RunningGear, NosesRiseAtBothEndsSoThatATrackClimbs) {
  double highest_front_m = 0, highest_rear_m = 0;
  for (const ContactPatch& patch : TrackPatches(kTrack)) {
    EXPECT_NEAR(patch.outward_B.norm(), 1, 1e-12);
    EXPECT_NEAR(patch.travel_B.dot(patch.outward_B), 0, 1e-12);
    if (patch.p_B_m.x() > 0.9) {
      highest_front_m = std::max(highest_front_m, patch.p_B_m.z());
      EXPECT_GT(patch.outward_B.x(), 0);
      EXPECT_LE(patch.travel_B.z(), 0);  // the front of a driving track comes down
    }
    if (patch.p_B_m.x() < -0.7) {
      highest_rear_m = std::max(highest_rear_m, patch.p_B_m.z());
      EXPECT_LT(patch.outward_B.x(), 0);
      EXPECT_GE(patch.travel_B.z(), 0);
    }
  }
  EXPECT_GT(highest_front_m, 0.05 + 0.15);
  EXPECT_GT(highest_rear_m, 0.05 + 0.15);
}

TEST(RunningGear, ShoesRunBackwardsAlongTheGround) {
  const std::vector<Vec3> path = TrackPath(kTrack);
  double length_m = 0;
  int straight_runs = 0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Vec3 step = path[(i + 1) % path.size()] - path[i];
    length_m += step.norm();
    if (std::abs(step.z()) > 1e-9) continue;
    const bool on_ground = path[i].z() < 0.06;
    EXPECT_NEAR(step.x(), on_ground ? -1.6 : 1.6, 1e-12);
    ++straight_runs;
  }
  EXPECT_EQ(straight_runs, 2);
  // Two straight runs and a circle, short by the polygon's chords.
  const double exact_m = 2 * 1.6 + 2 * kPi * 0.25;
  EXPECT_LT(length_m, exact_m);
  EXPECT_NEAR(length_m, exact_m, 0.005 * exact_m);
}

TEST(RunningGear, EveryWheelTouchesTheGroundBelowItsAxle) {
  const std::vector<ContactPatch> patches = WheelPatches(
      {.axles_B_m = {Vec3(0.5, 0.6, 0.3), Vec3(-0.4, 0.6, 0.3)}, .radius_m = 0.3, .width_m = 0.2});
  for (const double x : {0.5, -0.4}) {
    double lowest_m = 1, lowest_x = 0;
    for (const ContactPatch& patch : patches) {
      if (std::abs(patch.p_B_m.x() - x) > 0.3 || patch.p_B_m.z() >= lowest_m) continue;
      lowest_m = patch.p_B_m.z();
      lowest_x = patch.p_B_m.x();
    }
    EXPECT_NEAR(lowest_m, 0, 1e-12);
    EXPECT_NEAR(lowest_x, x, 1e-12);
  }
}

}  // namespace
}  // namespace tera
