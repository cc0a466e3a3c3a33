#include "resimulate/motion/recorded_motion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "dataset/format/sample_recording.h"
#include "resimulate/recorded_cart.h"

namespace tera {
namespace {

using testing::HasSubstr;

constexpr int kRecordedMotionMast = 1;

class RecordedMotionOfACart : public testing::Test {
 protected:
  RecordedMotion Motion(const RecordedCart& cart) {
    return {scenario_.machines[0].placement, cart.machine, WriteCart(scratch_.path() / "r", cart)};
  }

  const ScratchDirectory scratch_;
  const Scenario scenario_ = CartScenario(scratch_.path());
};

/// From (1, 2, 0.5), turned left by 30 deg, to (5, 0, 0.5), turned left by 90 deg, in two seconds
/// from 1 s on.
Pose RecordedMotionStraight(double t_s) {
  const double part = 0.5 * (t_s - 1);
  return MakePose(Vec3(1 + 4 * part, 2 - 2 * part, 0.5),
                  RotationFromRpy(0, 0, (30 + 60 * part) * kDeg));
}

TEST_F(RecordedMotionOfACart, BetweenTwoRowsTheBaseMovesStraightAndTurnsEvenly) {
  const auto motion =
      Motion({.pose_t_ns = {FromSeconds(1), FromSeconds(3)}, .X_WB = RecordedMotionStraight});
  const BodyState base = motion.At(FromSeconds(2.5)).links[0];
  EXPECT_LT((base.X_WB.translation() - Vec3(4, 0.5, 0.5)).norm(), 1e-6);
  EXPECT_TRUE(base.X_WB.linear().isApprox(RotationFromRpy(0, 0, 75 * kDeg), 1e-6));
  EXPECT_LT((base.v_WB_mps - Vec3(2, -1, 0)).norm(), 1e-4);
  EXPECT_LT((base.w_WB_radps - Vec3(0, 0, 30 * kDeg)).norm(), 1e-4);
}

TEST_F(RecordedMotionOfACart, AnEncodersLineIsFoundAgainWhereverItIsAskedFor) {
  const auto line = [](double t_s) { return 0.4 + 0.3 * (t_s - 2); };
  const auto motion = Motion({.pose_t_ns = {FromSeconds(1), FromSeconds(3)},
                              .turn_t_ns = EvenTimes(1, 3, 0.01),
                              .X_WB = RecordedMotionStraight,
                              .turn_rad = line});
  for (const double t_s : {1.0, 1.003, 2.0, 2.0071, 2.998}) {  // ends and between samples too
    EXPECT_NEAR(motion.At(FromSeconds(t_s)).q_rad[0], line(t_s), 1e-9) << t_s;
  }
  const MachineState state = motion.At(FromSeconds(2.2));
  EXPECT_NEAR(state.qd_radps[0], 0.3, 1e-9);
  // The mast stands above the base and turns with both.
  const Vec3 p_W = RecordedMotionStraight(2.2) * Vec3(0, 0, kMastHeight_m);
  EXPECT_LT((state.links[kRecordedMotionMast].X_WB.translation() - p_W).norm(), 1e-6);
  EXPECT_NEAR(state.links[kRecordedMotionMast].w_WB_radps.z(), 0.3 + 30 * kDeg, 1e-4);
}

TEST_F(RecordedMotionOfACart, AJointThatFollowsAMeasuredOneIsWhereThatTakesIt) {
  MachinePlacement placement = scenario_.machines[0].placement;
  placement.model.links.push_back({.name = "flag"});
  placement.model.joints.push_back({.name = "wave",
                                    .type = JointType::kRevolute,
                                    .parent = kRecordedMotionMast,
                                    .child = 2,
                                    .following = Following{0, -0.5, 0.1}});
  placement.q_rad.push_back(0);
  const auto line = [](double t_s) { return 0.4 + 0.3 * (t_s - 2); };
  const RecordedCart cart = {.pose_t_ns = {FromSeconds(1), FromSeconds(3)},
                             .turn_t_ns = EvenTimes(1, 3, 0.01),
                             .X_WB = RecordedMotionStraight,
                             .turn_rad = line};
  const RecordedMotion motion(placement, cart.machine, WriteCart(scratch_.path() / "r", cart));
  EXPECT_TRUE(motion.shows_whole());
  EXPECT_TRUE(motion.Carries(2));
  const MachineState state = motion.At(FromSeconds(2.2));
  EXPECT_NEAR(state.q_rad[1], 0.1 - 0.5 * line(2.2), 1e-9);
  EXPECT_NEAR(state.qd_radps[1], -0.5 * 0.3, 1e-9);
}

TEST_F(RecordedMotionOfACart, ErrorsThatAlternateFromSampleToSampleAreAFifthInTheirMean) {
  constexpr double kError_rad = 0.01;
  const auto noisy = [](double t_s) {
    return 0.2 * t_s + (std::llround(100 * t_s) % 2 == 0 ? kError_rad : -kError_rad);
  };
  const auto motion = Motion({.pose_t_ns = {FromSeconds(1), FromSeconds(3)},
                              .turn_t_ns = EvenTimes(1, 3, 0.01),
                              .X_WB = RecordedMotionStraight,
                              .turn_rad = noisy});
  // Three of the five samples within 25 ms err to one side and two to the other.
  EXPECT_NEAR(motion.At(FromSeconds(2)).q_rad[0], 0.4 + kError_rad / 5, 1e-9);
  EXPECT_NEAR(motion.At(FromSeconds(2.01)).q_rad[0], 0.402 - kError_rad / 5, 1e-9);
}

TEST_F(RecordedMotionOfACart, BetweenSamplesThatAreFarApartTheJointMovesStraight) {
  const auto motion = Motion({.pose_t_ns = {FromSeconds(1), FromSeconds(3)},
                              .turn_t_ns = EvenTimes(1, 3, 0.2),
                              .X_WB = RecordedMotionStraight,
                              .turn_rad = [](double t_s) { return t_s * t_s; }});
  const double before = 2.0 * 2.0, after = 2.2 * 2.2;
  EXPECT_NEAR(motion.At(FromSeconds(2.05)).q_rad[0], before + 0.25 * (after - before), 1e-9);
}

TEST_F(RecordedMotionOfACart, IsKnownAMomentBeyondWhatPosesAndEncodersCoverAndNoFurther) {
  const auto motion = Motion({.pose_t_ns = EvenTimes(1, 5, 0.1),
                              .turn_t_ns = EvenTimes(1.5, 4, 0.1),
                              .X_WB = RecordedMotionStraight,
                              .turn_rad = [](double) { return 0.1; }});
  EXPECT_EQ(motion.first_ns(), FromSeconds(1));
  EXPECT_FALSE(motion.IsKnownAt(FromSeconds(1.1)));  // of the poses alone
  EXPECT_TRUE(motion.IsKnownAt(FromSeconds(1.25)));
  EXPECT_TRUE(motion.IsKnownAt(FromSeconds(4.25)));
  EXPECT_FALSE(motion.IsKnownAt(FromSeconds(4.35)));
}

TEST_F(RecordedMotionOfACart, IsNotKnownWithinAGapOfAMeasurement) {
  std::vector<TimeNs> with_gap = EvenTimes(1, 3, 0.1);
  for (const TimeNs t_ns : EvenTimes(6, 9, 0.1)) with_gap.push_back(t_ns);
  RecordedCart cart{.pose_t_ns = EvenTimes(1, 9, 0.1),
                    .turn_t_ns = with_gap,
                    .X_WB = RecordedMotionStraight,
                    .turn_rad = [](double) { return 0.1; }};
  const auto of_encoder = Motion(cart);
  std::swap(cart.pose_t_ns, cart.turn_t_ns);
  const auto of_poses = Motion(cart);
  for (const RecordedMotion* motion : {&of_encoder, &of_poses}) {
    EXPECT_TRUE(motion->IsKnownAt(FromSeconds(2.95)));
    EXPECT_TRUE(motion->IsKnownAt(FromSeconds(3.2)));
    EXPECT_FALSE(motion->IsKnownAt(FromSeconds(4.5)));
    EXPECT_TRUE(motion->IsKnownAt(FromSeconds(5.8)));
    EXPECT_TRUE(motion->IsKnownAt(FromSeconds(7)));
  }
}

TEST_F(RecordedMotionOfACart, PosesOnceASecondHaveNoGaps) {
  const auto motion = Motion({.pose_t_ns = EvenTimes(1, 9, 1), .X_WB = RecordedMotionStraight});
  EXPECT_TRUE(motion.IsKnownAt(FromSeconds(4.5)));
}

TEST_F(RecordedMotionOfACart, AJointWithoutEncoderStaysAsTheScenarioHasItAndIsNotShown) {
  const auto motion = Motion({.pose_t_ns = EvenTimes(1, 3, 0.1), .X_WB = RecordedMotionStraight});
  EXPECT_NEAR(motion.At(FromSeconds(2)).q_rad[0], 40 * kDeg, 1e-12);
  EXPECT_FALSE(motion.shows_whole());
  EXPECT_TRUE(motion.Carries(0));
  EXPECT_FALSE(motion.Carries(kRecordedMotionMast));
}

TEST_F(RecordedMotionOfACart, WithAnEncoderOfEveryJointTheMachineIsShownWhole) {
  const auto motion = Motion({.pose_t_ns = EvenTimes(1, 3, 0.1),
                              .turn_t_ns = EvenTimes(1, 3, 0.1),
                              .X_WB = RecordedMotionStraight,
                              .turn_rad = [](double) { return 0.1; }});
  EXPECT_TRUE(motion.shows_whole());
  EXPECT_TRUE(motion.Carries(kRecordedMotionMast));
}

TEST_F(RecordedMotionOfACart, WithoutPosesItSaysOfWhichMachineTheyAreMissing) {
  const auto motion =
      Motion({.turn_t_ns = EvenTimes(1, 3, 0.1), .turn_rad = [](double) { return 0.1; }});
  EXPECT_THAT(motion.obstacle(), HasSubstr("no poses of real_cart"));
  EXPECT_FALSE(motion.IsKnownAt(FromSeconds(2)));
}

TEST(RecordedMotion, OnAFixedBaseWithoutPosesTheMachineStaysWhereItWasPlaced) {
  const ScratchDirectory scratch;
  const Scenario scenario = CartScenario(scratch.path(), "", true);
  const RecordedCart cart{.turn_t_ns = EvenTimes(1, 3, 0.01),
                          .turn_rad = [](double t_s) { return 0.1 * t_s; }};
  const RecordedMotion motion(scenario.machines[0].placement, cart.machine,
                              WriteCart(scratch.path() / "r", cart));
  EXPECT_EQ(motion.obstacle(), "");
  const MachineState state = motion.At(FromSeconds(2));
  EXPECT_LT((state.links[0].X_WB.translation() - Vec3(3, -2, 0)).norm(), 1e-6);
  EXPECT_TRUE(state.links[kRecordedMotionMast].X_WB.linear().isApprox(
      RotationFromRpy(0, 0, 30 * kDeg + 0.2), 1e-6));
}

}  // namespace
}  // namespace tera
