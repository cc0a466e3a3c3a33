#include <algorithm>
#include <cmath>

#include "core/faults.h"
#include "serve/live_stage_fixture.h"

// Several environments of one session, episodes that are prepared, and truth for rewards.

namespace tera {
namespace {

v1::Turn ResetTurn(std::uint32_t environment, std::uint64_t seed) {
  v1::Turn turn;
  turn.set_environment(environment);
  turn.mutable_reset()->set_seed(seed);
  return turn;
}

v1::Turn StepTurn(std::uint32_t environment, const v1::Step& step) {
  v1::Turn turn;
  turn.set_environment(environment);
  *turn.mutable_step() = step;
  return turn;
}

v1::Batch BatchOf(const std::vector<v1::Turn>& turns) {
  v1::Batch batch;
  for (const v1::Turn& turn : turns) *batch.add_turns() = turn;
  return batch;
}

class EnvironmentsTest : public LiveStageTest {
 protected:
  /// Bytes of an episode's observations by plain requests to a stage of its own.
  std::vector<std::string> Alone(std::uint64_t seed, const v1::Step& step) {
    const std::unique_ptr<Stage> alone = NewStage();
    v1::Reset reset;
    reset.set_seed(seed);
    std::vector<std::string> told = {Bytes(alone->Reset(reset).value())};
    for (int k = 0; k < 3; ++k) told.push_back(Bytes(alone->Step(step).value()));
    return told;
  }
  static std::string Bytes(v1::Observation observation) {
    observation.clear_described_anew();
    return observation.SerializeAsString();
  }
  v1::Step Dig() {
    v1::Step step = Lever("boom", -0.5, 40);
    v1::SensorSelection& selection = *step.mutable_observe()->add_sensors();
    selection.set_machine("digger");
    selection.set_sensor("imu");
    return step;
  }
};

TEST_F(EnvironmentsTest, ABatchGivesEachEnvironmentWhatItWouldHaveAlone) {
  const v1::Step step = Dig();
  std::vector<std::string> told[3];
  const auto keep = [&](const v1::Outcomes& outcomes) {
    ASSERT_EQ(outcomes.outcomes_size(), 3);
    for (int k = 0; k < 3; ++k) told[2 - k].push_back(Bytes(outcomes.outcomes(k).observation()));
  };
  keep(stage_->Do(BatchOf({ResetTurn(2, 12), ResetTurn(1, 11), ResetTurn(0, 10)})).value());
  for (int k = 0; k < 3; ++k) {
    keep(stage_->Do(BatchOf({StepTurn(2, step), StepTurn(1, step), StepTurn(0, step)})).value());
  }
  for (int environment = 0; environment < 3; ++environment) {
    EXPECT_TRUE(told[environment] == Alone(10 + environment, step)) << environment;
  }
}

TEST_F(EnvironmentsTest, RefusesTurnsByThemselvesAndFaultyBatchesAsAWhole) {
  stage_->Do(BatchOf({ResetTurn(0, 1), ResetTurn(1, 1)}));
  v1::Turn of_no_kind;
  of_no_kind.set_environment(3);
  const v1::Outcomes outcomes = stage_
                                    ->Do(BatchOf({StepTurn(0, StepOf(0)), StepTurn(1, StepOf(5)),
                                                  StepTurn(2, StepOf(5)), of_no_kind}))
                                    .value();
  EXPECT_THAT(outcomes.outcomes(0).refusal().message(),
              testing::HasSubstr("at least one physics step"));
  EXPECT_FALSE(outcomes.outcomes(0).refusal().episode_over());
  EXPECT_EQ(outcomes.outcomes(1).observation().time_ns(), 10'000'000);
  EXPECT_THAT(outcomes.outcomes(2).refusal().message(), testing::HasSubstr("need Reset"));
  EXPECT_THAT(outcomes.outcomes(3).refusal().message(), testing::HasSubstr("of no kind"));
  EXPECT_THROW(stage_->Do(BatchOf({ResetTurn(1, 1), ResetTurn(1, 2)})), InputError);
  EXPECT_THROW(stage_->Do(BatchOf({ResetTurn(kMostEnvironments, 1)})), InputError);
  EXPECT_THROW(stage_->Describe(kMostEnvironments), InputError);
}

TEST_F(EnvironmentsTest, RefusesABatchWhoseObservationsAreTooLargeForAMessageBeforeAnyTurn) {
  v1::Batch batch = BatchOf({});
  for (std::uint32_t environment = 0; environment < 5; ++environment) {
    v1::Turn turn = ResetTurn(environment, 5);
    for (int k = 0; k < 60; ++k) {  // 4 MB each: 240 MB a turn, less than its own limit
      v1::PatchSelection& patch = *turn.mutable_reset()->mutable_observe()->add_patches();
      patch.set_machine("digger");
      patch.set_size_m(100);
      patch.set_resolution_m(0.1);
    }
    *batch.add_turns() = turn;
  }
  EXPECT_THAT([&] { stage_->Do(batch); }, ThrowsFault(FaultKind::kOutOfRange));
  EXPECT_FALSE(stage_->InEpisode());
}

TEST_F(EnvironmentsTest, EpisodesOfABatchAreRecordedInTheOrderOfItsTurns) {
  const std::filesystem::path folder = OwnFolder() / "recorded";
  {
    const std::unique_ptr<Stage> stage = NewStage({.threads = 4, .record = folder});
    for (const std::uint64_t seed : {10U, 20U}) {
      std::vector<v1::Turn> turns;
      for (std::uint32_t k = 0; k < 4; ++k) turns.push_back(ResetTurn(k, seed + k));
      const v1::Outcomes outcomes = stage->Do(BatchOf(turns)).value();
      for (const v1::Outcome& outcome : outcomes.outcomes()) EXPECT_TRUE(outcome.has_observation());
    }
  }
  for (std::uint64_t k = 0; k < 8; ++k) {
    const std::filesystem::path scenario =
        folder / fmt::format("episode_{:04}", k + 1) / "scenario.yaml";
    ASSERT_TRUE(std::filesystem::exists(scenario)) << k;
    EXPECT_EQ(LoadScenario(scenario, {}).scenario.seed, 10 * (k / 4 + 1) + k % 4) << k;
  }
}

TEST_F(EnvironmentsTest, APreparedEpisodeIsTheOneThatTheResetWouldMake) {
  const v1::Step step = Dig();
  v1::Reset reset;
  reset.set_seed(3);
  reset.set_next_seed(4);
  stage_->Reset(reset);
  stage_->Step(step);
  const auto episode = [&](std::uint64_t seed) {
    v1::Reset request;
    request.set_seed(seed);
    request.set_next_seed(4);
    std::vector<std::string> told = {Bytes(stage_->Reset(request).value())};
    for (int k = 0; k < 3; ++k) told.push_back(Bytes(stage_->Step(step).value()));
    return told;
  };
  EXPECT_TRUE(episode(4) == Alone(4, step));  // as foretold
  EXPECT_TRUE(episode(5) == Alone(5, step));  // another than foretold
}

TEST_F(EnvironmentsTest, APreparedEpisodeServesOnlyTheObservationItWasMadeFor) {
  v1::Reset reset;
  reset.set_seed(3);
  reset.set_next_seed(3);
  stage_->Reset(reset);
  v1::SensorSelection& selection = *reset.mutable_observe()->add_sensors();
  selection.set_machine("digger");
  selection.set_sensor("encoders");
  EXPECT_EQ(stage_->Reset(reset).value().samples_size(), 1);
}

TEST_F(EnvironmentsTest, WorkIsThatOfDrivingJointsSinceTheReset) {
  const auto work = [&](const v1::Observation& observation) {
    return observation.machines(0).work_j();
  };
  EXPECT_EQ(work(Reset()), 0);
  const double dt_s = 1 / description_.physics_rate_hz();
  double sum_j = 0;
  v1::Observation last;
  for (int k = 0; k < 100; ++k) {
    last = Step(Lever("boom", 0.5, 1));
    const v1::MachineState& digger = last.machines(0);
    for (int j = 0; j < digger.joint_effort_size(); ++j) {
      sum_j += std::max(0.0, digger.joint_effort(j) * digger.joint_rate(j)) * dt_s;
    }
  }
  EXPECT_GT(sum_j, 10);
  EXPECT_NEAR(work(last), sum_j, 1e-6 * sum_j);
  // Lowered, gravity drives and the joint brakes.
  const double raised_j = work(last);
  EXPECT_LT(work(Step(Lever("boom", -0.3, 100))) - raised_j, 0.2 * raised_j);
  EXPECT_EQ(work(Reset()), 0);
}

TEST(Environments, AMachineTouchesTheObstacleThatItDrivesAgainst) {
  const std::string text = std::string(kStageScenario) + R"(
obstacles:
  - {name: wall, preset: tera:config/obstacles/container.yaml, xy_m: [-4, 0.5], yaw_deg: 20}
  - {name: far, preset: tera:config/obstacles/container.yaml, xy_m: [4, 5]}
)";
  const ScenarioSource source = SourceOfText(text, "touch.yaml");
  const std::unique_ptr<Stage> stage = LiveStages(*source(std::nullopt).scenario, source, {},
                                                  [](const std::string&) {})([] { return false; });
  const v1::Observation start = stage->Reset(v1::Reset()).value();
  EXPECT_EQ(start.machines(1).touches_size(), 0);
  v1::Step step = StepOf(2500);
  v1::Action& action = *step.add_actions();
  action.set_machine("rover");
  for (int k = 0; k < stage->Describe(0).machines(1).levers_size(); ++k) {
    action.mutable_levers()->add_position(0.5);
  }
  const v1::Observation end = stage->Step(step).value();
  ASSERT_EQ(end.machines(1).touches_size(), 1);
  EXPECT_EQ(end.machines(1).touches(0), "wall");
  EXPECT_EQ(end.machines(0).touches_size(), 0);
}

TEST(Environments, ATouchInTheMiddleOfALongStepIsObserved) {
  // A cart drives against the standing rover at 0.6 s and is back at 1.2 s.
  const std::string text = std::string(kStageScenario) + R"(
obstacles:
  - {name: cart, label: structure, mesh: tera:assets/rock.glb, xy_m: [-5, 8],
     path: [{t_s: 0, xy_m: [-5, 8]}, {t_s: 0.6, xy_m: [-5, 4.6]}, {t_s: 1.2, xy_m: [-5, 8]}],
     collision: [{xyz_m: [0, 0, 0.5], size_m: [0.6, 0.6, 1]}]}
)";
  const ScenarioSource source = SourceOfText(text, "cart.yaml");
  const std::unique_ptr<Stage> stage = LiveStages(*source(std::nullopt).scenario, source, {},
                                                  [](const std::string&) {})([] { return false; });
  EXPECT_EQ(stage->Reset(v1::Reset()).value().machines(1).touches_size(), 0);
  v1::Step step;
  step.set_duration_s(1.8);
  const v1::Observation after = stage->Step(step).value();
  ASSERT_EQ(after.machines(1).touches_size(), 1);
  EXPECT_EQ(after.machines(1).touches(0), "cart");
  EXPECT_EQ(stage->Step(StepOf(1)).value().machines(1).touches_size(), 0);
}

}  // namespace
}  // namespace tera
