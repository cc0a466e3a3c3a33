#include <cmath>
#include <tuple>

#include "serve/live_stage_fixture.h"

// Effects of requests on a simulation, and refused requests.

namespace tera {
namespace {

TEST_F(LiveStageTest, ResetsToTheStartOfTheScenario) {
  const v1::Observation start = Reset();
  EXPECT_EQ(start.time_ns(), 0);
  EXPECT_EQ(start.machines_size(), 2);
  const v1::MachineState& digger = start.machines(0);
  EXPECT_EQ(digger.name(), "digger");
  EXPECT_NEAR(digger.x_wb().position_m().x(), 1, 0.05);
  EXPECT_NEAR(digger.x_wb().position_m().y(), -2, 0.05);
  // Half of 30 degrees about z.
  EXPECT_NEAR(digger.x_wb().rotation().w(), std::cos(M_PI / 12), 0.02);
  EXPECT_NEAR(digger.x_wb().rotation().z(), std::sin(M_PI / 12), 0.02);
  EXPECT_NEAR(JointAt(start, "boom"), 40 * M_PI / 180, 0.05);
}

TEST_F(LiveStageTest, StepsByPhysicsStepsOrBySeconds) {
  Reset();
  const double rate_hz = description_.physics_rate_hz();
  EXPECT_EQ(Step(StepOf(7)).time_ns(), std::llround(7e9 / rate_hz));
  v1::Step seconds;
  seconds.set_duration_s(0.1);
  EXPECT_EQ(Step(seconds).time_ns(), std::llround(1e9 * (7 / rate_hz + 0.1)));
  seconds.set_duration_s(1e-6);
  EXPECT_EQ(Step(seconds).time_ns(), std::llround(1e9 * (8 / rate_hz + 0.1)));
}

TEST_F(LiveStageTest, ALeverMovesItsJointForTheWholeOfALongStep) {
  const double before_rad = JointAt(Reset(), "boom");
  const v1::Observation after = Step(Lever("boom", -0.5, 250));
  const double half_second_rad = JointAt(after, "boom") - before_rad;
  EXPECT_LT(half_second_rad, -0.05);
  EXPECT_EQ(after.machines(0).lever(LeverOf(digger_, "boom")), -0.5);
  // Longer than a command's own duration.
  Reset();
  const v1::Observation late = Step(Lever("swing", 0.2, 800));
  EXPECT_EQ(late.machines(0).lever(LeverOf(digger_, "swing")), 0.2);
}

TEST_F(LiveStageTest, WhoIsNotNamedAnyMoreHoldsTheLeversNeutral) {
  Reset();
  Step(Lever("boom", -0.5, 50));
  EXPECT_EQ(Step(StepOf(1)).machines(0).lever(LeverOf(digger_, "boom")), 0.0);
}

TEST_F(LiveStageTest, AnActionWithoutACommandAndALockAreNeutral) {
  Reset();
  v1::Step step = Lever("boom", -0.5, 1);
  step.mutable_actions(0)->set_hydraulic_lock(true);
  EXPECT_EQ(Step(step).machines(0).lever(LeverOf(digger_, "boom")), 0.0);
  step.mutable_actions(0)->clear_hydraulic_lock();
  EXPECT_EQ(Step(step).machines(0).lever(LeverOf(digger_, "boom")), -0.5);
  step.mutable_actions(0)->clear_levers();
  EXPECT_EQ(Step(step).machines(0).lever(LeverOf(digger_, "boom")), 0.0);
}

TEST_F(LiveStageTest, JointRatesAndPositionsAreReached) {
  const v1::Observation start = Reset();
  v1::Step step = StepOf(500);
  v1::Action& action = *step.add_actions();
  action.set_machine("digger");
  for (const v1::Lever& lever : digger_.levers()) {
    action.mutable_joint_rates()->add_rate(lever.joint() == "arm" ? 0.15 : 0.0);
  }
  const v1::Observation turned = Step(step);
  EXPECT_NEAR(JointAt(turned, "arm") - JointAt(start, "arm"), 0.15, 0.03);
  for (const v1::Lever& lever : digger_.levers()) {
    const double at = lever.joint().empty() ? 0 : JointAt(turned, lever.joint());
    action.mutable_joint_positions()->add_position(lever.joint() == "arm" ? at - 0.2 : at);
  }
  step.set_physics_steps(1500);
  EXPECT_NEAR(JointAt(Step(step), "arm"), JointAt(turned, "arm") - 0.2, 0.02);
}

TEST_F(LiveStageTest, TheSameSeedGivesTheSameBytesAndAnotherOtherNoise) {
  const auto whole = [&](std::uint64_t seed) {
    v1::Reset reset;
    reset.set_seed(seed);
    stage_->Reset(reset);
    v1::Step step = Lever("boom", -0.3, 60);
    for (const char* sensor : {"imu", "gnss", "lidar", "encoders"}) {
      v1::SensorSelection& selection = *step.mutable_observe()->add_sensors();
      selection.set_machine("digger");
      selection.set_sensor(sensor);
    }
    return Step(step).SerializeAsString();
  };
  const std::string first = whole(1);
  EXPECT_TRUE(whole(1) == first);
  EXPECT_FALSE(whole(2) == first);
}

TEST(LiveStages, AResetDrawsTheYardOfItsSeed) {
  const std::string text = std::string(kStageScenario) + R"(
randomise:
  - {key: 'machines[0].start.yaw_deg', uniform: [-180, 180]}
  - {key: 'terrain.size_m', choice: [[16, 16], [18, 18], [20, 20], [22, 22]]}
)";
  const ScenarioSource source = SourceOfText(text, "yards.yaml");
  const std::unique_ptr<Stage> stage = LiveStages(*source(std::nullopt).scenario, source, {},
                                                  [](const std::string&) {})([] { return false; });
  const auto yard = [&](std::uint64_t seed) {
    v1::Reset reset;
    reset.set_seed(seed);
    v1::Observation observation = stage->Reset(reset).value();
    const bool anew = observation.described_anew();
    observation.clear_described_anew();
    return std::tuple(observation.SerializeAsString(), anew, stage->Describe(0).site().x_max_m());
  };
  const auto [first, first_anew, first_m] = yard(1);
  const auto [again, again_anew, again_m] = yard(1);
  EXPECT_TRUE(first == again);
  EXPECT_FALSE(again_anew);
  int yards = 0;
  for (std::uint64_t seed = 2; seed < 8; ++seed) {
    const double before_m = stage->Describe(0).site().x_max_m();
    const auto [other, anew, x_max_m] = yard(seed);
    EXPECT_FALSE(other == first);
    EXPECT_EQ(anew, x_max_m != before_m);
    yards += anew;
  }
  EXPECT_GT(yards, 0);  // with 4 sizes, 6 draws are of one size in 4^-5 of all cases
}

TEST_F(LiveStageTest, RefusesWhatCannotBeDoneAndChangesNothing) {
  Reset();
  ExpectRefused(StepOf(0), "at least one physics step");
  ExpectRefused(v1::Step(), "at least one physics step");
  v1::Step step;
  step.set_duration_s(-1);
  ExpectRefused(step, "a step of -1 s");
  step.set_duration_s(std::nan(""));
  ExpectRefused(step, "a step of nan s");
  step.set_duration_s(1e9);
  ExpectRefused(step, "at most 3600 s");
  step = Lever("boom", 1.5, 1);
  ExpectRefused(step, "lever 'boom' is 1.5, need -1 to 1");
  step = Lever("boom", std::nan(""), 1);
  ExpectRefused(step, "need a finite number");
  step = Lever("boom", 1, 1);
  step.mutable_actions(0)->mutable_levers()->add_position(0);
  ExpectRefused(step, "one for each lever");
  step = Lever("boom", 1, 1);
  *step.add_actions() = step.actions(0);
  ExpectRefused(step, "two actions in one step");
  step.mutable_actions(1)->set_machine("crane");
  ExpectRefused(step, "no machine named 'crane'; need one of: digger, rover");
  step = StepOf(1);
  step.add_actions()->set_machine("digger");
  step.mutable_actions(0)->mutable_tool_pose()->set_frame("nose");
  ExpectRefused(step, "no frame 'nose'");
  v1::ToolPose& pose = *step.mutable_actions(0)->mutable_tool_pose();
  pose.set_frame("bucket_tip");
  pose.mutable_position_b_m()->set_z(1e308);
  ExpectRefused(step, "the place of 'bucket_tip' is beyond 1000 m");
  pose.clear_position_b_m();
  pose.mutable_rotation_b();  // all 0, as an empty message is
  ExpectRefused(step, "the quaternion of tool frame 'bucket_tip' has length 0, need 1");
  pose.mutable_rotation_b()->set_w(5);
  ExpectRefused(step, "has length 5, need 1");
  EXPECT_EQ(Step(StepOf(1)).time_ns(), 2'000'000);
}

TEST(LiveStages, LeavesALongStepWhenTheSessionHasEnded) {
  int asked = 0;
  const std::unique_ptr<Stage> stage = NewStage({}, [&] { return ++asked > 100; });
  stage->Reset(v1::Reset());
  EXPECT_FALSE(stage->Step(StepOf(100000)).has_value());
  EXPECT_EQ(asked, 101);
}

}  // namespace
}  // namespace tera
