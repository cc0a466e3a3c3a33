#include "sim/scenario/gait.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/faults.h"
#include "core/units.h"
#include "sim/scenario/scenario_text.h"

namespace tera {
namespace {

using enum FaultKind;

std::string Walker(const std::string& gait) {
  return std::string(kSite) + kExcavator +
         "obstacles: [{name: p, preset: 'tera:config/obstacles/person_walking.yaml', xy_m: [4, 4]" +
         gait + "}]\n";
}

/// A thigh of 0.4 m from z = 0.9 down and a shank of 0.4 m below it.
Gait Leg() {
  Gait gait{.stride_m = 1.6, .rise_m = {0, 0.04}};
  gait.limbs.push_back({.name = "thigh", .joint_B_m = Vec3(0, 0.1, 0.9), .swing_rad = {0, 0.5}});
  gait.limbs.push_back(
      {.name = "shank", .of = 0, .joint_B_m = Vec3(0, 0.1, 0.5), .swing_rad = {0, -90 * kDeg}});
  return gait;
}

TEST(Gait, LimbsSwingForwardsAboutTheirJointsAndCarryEachOther) {
  const std::vector<Pose> half = LimbPoses(Leg(), 1, 0.8);  // half a stride
  const Vec3 knee = half[0] * Vec3(0, 0.1, 0.5);
  EXPECT_NEAR(knee.x(), 0.4 * std::sin(0.5), 1e-12) << "forwards";
  EXPECT_NEAR(knee.z(), 0.9 - 0.4 * std::cos(0.5), 1e-12);
  EXPECT_NEAR((half[1] * Vec3(0, 0.1, 0.5) - knee).norm(), 0, 1e-12) << "the shank hangs on it";
  // A shank bent back by a right angle is square to the thigh.
  const Vec3 ankle = half[1] * Vec3(0, 0.1, 0.1);
  EXPECT_NEAR((ankle - knee).dot(knee - Vec3(0, 0.1, 0.9)), 0, 1e-12);
  EXPECT_LT(ankle.x(), knee.x());
  EXPECT_NEAR(RiseOf(Leg(), 1, 0.8), 0.04, 1e-12);
}

TEST(Gait, ComesRoundAfterAStrideAndIsStraightBetweenItsMoments) {
  for (const double travel_m : {0.1, 0.7, 1.3}) {
    const std::vector<Pose> a = LimbPoses(Leg(), 1, travel_m),
                            b = LimbPoses(Leg(), 1, travel_m + 4.8);
    EXPECT_NEAR((a[1].matrix() - b[1].matrix()).norm(), 0, 1e-12);
  }
  EXPECT_NEAR(RiseOf(Leg(), 1, 0.2), 0.01, 1e-12);
  EXPECT_NEAR(RiseOf(Leg(), 1, 1.4), 0.01, 1e-12);
  EXPECT_NEAR(RiseOf(Leg(), 2, 0.4), 0.02, 1e-12) << "twice as large, twice the stride";
}

TEST(Gait, EveryFaultIsNamed) {
  EXPECT_THAT(ScenarioFaults(Walker("")), testing::IsEmpty());
  EXPECT_THAT(ScenarioFaults(Walker(", gait: {stride_m: 0}")),
              HasFault(kOutOfRange, "obstacles[0].gait.stride_m"));
  EXPECT_THAT(
      ScenarioFaults(Walker(", gait: {limbs: [{name: tail, node: trunk, of: left_tigh, joint_m: "
                            "[0, 0, 1], swing_deg: [0]}]}")),
      HasFault(kNoSuchName));
  EXPECT_THAT(ScenarioFaults(Walker(", keypoints: [{name: nose, limb: head, xyz_m: [0, 0, 1]}]")),
              HasFault(kNoSuchName, "keypoints[0].limb"));
  EXPECT_THAT(ScenarioFaults(Walker(", gait: {rise_m: [5]}")), HasFaultAt("rise_m"));
  EXPECT_THAT(ScenarioFaults(Walker(", gait: {rise_m: [0, 0.1], limbs: []}")),
              HasFault(kMissing, "gait.limbs"));
  const std::string limb = "{name: leg, node: trunk, joint_m: [0, 0, 1], swing_deg: [0]}";
  EXPECT_THAT(ScenarioFaults(Walker(", gait: {limbs: [" + limb + ", " + limb + "]}")),
              HasFaultAt("limbs[1].name"));
}

}  // namespace
}  // namespace tera
