#include "physics/actuation/learned_rate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "physics/actuation/actuation.h"
#include "physics/actuation/actuation_faults.h"
#include "physics/machine_fixture.h"

// Learned effects, without a mechanism's name, at the end of the chain.

namespace tera {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

using Kind = LearnedVariable::Kind;

/// 2 x - 1 between -10 and 10.
LearnedEffect Line(Kind kind, bool is_share) {
  return {{"x", "1", kind, 0}, is_share, {-10, 10}, {-21, 19}, {-21, 19}, {-21, 19}};
}

TEST(LearnedRate, AsAShareIsAFactorOnTheRate) {
  LearnedEffect effect = Line(Kind::kPosition, true);
  effect.at = {0, 1};
  effect.value = {-0.5, 0.3};
  LearnedRate learned(effect);
  // At a quarter between: -0.5 + 0.25 * 0.8.
  EXPECT_NEAR(learned.Step(0.4, {.position_rad = 0.25}), 0.4 * 0.7, 1e-15);
  EXPECT_NEAR(learned.Step(-0.4, {.position_rad = 0.25}), -0.4 * 0.7, 1e-15);
  EXPECT_EQ(learned.Step(0, {.position_rad = 0.25}), 0);
}

TEST(LearnedRate, AddedTurnsNothingThatStandsAndTurnsNothingBack) {
  LearnedRate learned(Line(Kind::kLoad, false));
  // c = 0.2 at 0.6, and -0.2 at 0.4.
  EXPECT_NEAR(learned.Step(0.5, {.load_nm = 0.6}), 0.7, 1e-12);
  EXPECT_NEAR(learned.Step(-0.5, {.load_nm = 0.6}), -0.3, 1e-12);
  EXPECT_EQ(learned.Step(0, {.load_nm = 0.6}), 0);
  EXPECT_EQ(learned.Step(0, {.load_nm = 0.4}), 0);
  EXPECT_EQ(learned.Step(0.1, {.load_nm = 0.4}), 0);             // not to -0.1
  EXPECT_EQ(learned.Step(-0.1, {.load_nm = 0.6}), 0);            // not to 0.1
  EXPECT_NEAR(learned.Step(0.1, {.load_nm = 0.6}), 0.2, 1e-12);  // at most twice as fast
}

TEST(LearnedRate, KnowsItsVariableAlone) {
  const LearnedInput input{.lever = 1, .position_rad = 2, .load_nm = 3, .time_s = 4};
  const auto added = [&](Kind kind) {
    return LearnedRate(Line(kind, false)).Step(100, input) - 100;
  };
  EXPECT_NEAR(added(Kind::kLever), 1, 1e-12);
  EXPECT_NEAR(added(Kind::kPosition), 3, 1e-12);
  EXPECT_NEAR(added(Kind::kLoad), 5, 1e-12);
  EXPECT_NEAR(added(Kind::kTime), 7, 1e-12);
  EXPECT_NEAR(LearnedRate(Line(Kind::kRate, false)).Step(9, input), 9 + 9, 1e-12);  // 17, as 9
  EXPECT_NEAR(LearnedRate(Line(Kind::kRate, false)).Step(0.8, input), 0.8 + 0.6, 1e-12);
}

TEST(LearnedRate, KnowsTheWayOfALeverFromWhereItMovedLast) {
  LearnedRate learned(Line(Kind::kLeverWay, false));
  const auto way = [&](double lever) { return (learned.Step(100, {.lever = lever}) - 99) / 2; };
  EXPECT_NEAR(way(0), 0, 1e-12);
  EXPECT_NEAR(way(0.3), 1, 1e-12);
  EXPECT_NEAR(way(0.5), 1, 1e-12);
  EXPECT_NEAR(way(0.495), 1, 1e-12);  // it trembles
  EXPECT_NEAR(way(0.4), -1, 1e-12);
  EXPECT_NEAR(way(0.4), -1, 1e-12);
  EXPECT_NEAR(way(0), 0, 1e-12);
}

/// The lift arm with an effect on its rate, as a share over position.
MachineModel LiftWith(const LearnedEffect& effect) {
  MachineModel model = MachineFromText(kLiftArm);
  model.effects.learned = {effect};
  return model;
}

TEST(LearnedRate, ActsInASimulationByWhereTheJointIs) {
  // Full lever is 30 deg/s; a fifth less from 0 to 30 deg, no reduction beyond 60 deg.
  const LearnedEffect slower{{"position/lift", "rad", Kind::kPosition, 0},
                             true,
                             {0, 30 * kDeg, 60 * kDeg},
                             {-0.2, -0.2, 0},
                             {-0.2, -0.2, 0},
                             {-0.2, -0.2, 0}};
  MachineRun run(LiftWith(slower));
  run.input.levers = {1};
  run.StepFor(0.5);
  EXPECT_NEAR(run.state().qd_radps[0], 24 * kDeg, 1e-6);
  run.StepFor(2.5);
  ASSERT_GT(run.state().q_rad[0], 60 * kDeg);
  EXPECT_NEAR(run.state().qd_radps[0], 30 * kDeg, 1e-6);
}

TEST(LearnedRate, LeavesAJointAtRestUnderNeutralLevers) {
  const LearnedEffect large{
      {"load/lift", "N m", Kind::kLoad, 0}, false, {-1e4, 1e4}, {2, 2}, {2, 2}, {2, 2}};
  MachineRun run(LiftWith(large));
  run.StepFor(1);
  EXPECT_NEAR(run.state().q_rad[0], 0, 1e-6);
  run.input.levers = {0.1};
  run.StepFor(0.5);
  EXPECT_NEAR(run.state().qd_radps[0], 2 * 3 * kDeg, 1e-6);  // twice the response to a tenth
}

TEST(LearnedRate, CountsTimeFromTheStartOfTheScenario) {
  MachineModel model = MachineFromText(kLiftArm);
  model.effects.learned = {
      LearnedEffect{{"time", "s", Kind::kTime, 0}, true, {0, 1}, {-1, 0}, {-1, 0}, {-1, 0}}};
  const double full_radps = 30 * kDeg;
  const std::vector<double> levers = {1};
  const std::vector<AxisMotion> motions(1);
  Actuation from_zero(model, {.machine = "m"}), settled(model, {.machine = "m", .step = -2});
  for (int step = 0; step < 3; ++step) {
    from_zero.Step(levers, motions, 0.25);
    settled.Step(levers, motions, 0.25);
  }
  EXPECT_NEAR(from_zero.drives()[0].rate_radps, 0.5 * full_radps, 1e-12);
  EXPECT_NEAR(settled.drives()[0].rate_radps, 0, 1e-12);  // at t = 0
}

TEST(LearnedRate, AsksForLoadsOnlyWhereItDependsOnThem) {
  const auto reads = [](Kind kind) {
    return Actuation(LiftWith(Line(kind, true)), {.machine = "m"}).reads_loads();
  };
  EXPECT_TRUE(reads(Kind::kLoad));
  EXPECT_FALSE(reads(Kind::kPosition));
}

TEST(LearnedRate, MayDependOnWhatAMachineHas) {
  const MachineModel model = ShippedMachine("tb235");
  const auto boom = static_cast<std::size_t>(model.JointIndex("boom"));
  std::vector<std::string> names;
  for (const LearnedVariable& variable : LearnedVariablesOf(model, boom)) {
    names.push_back(variable.name + " " + variable.unit);
  }
  for (const char* name : {"lever/boom 1", "lever/arm 1", "lever_way/boom 1", "position/boom rad",
                           "load/boom N m", "rate rad/s", "time s"}) {
    EXPECT_THAT(names, Contains(name));
  }
  EXPECT_THAT(names, testing::Not(Contains("position/arm rad")));
}

TEST(LearnedRate, IsRefusedWhereNoLeverDrivesTheJoint) {
  MachineModel model = LiftWith(Line(Kind::kPosition, true));
  EXPECT_TRUE(FaultsOfJoint(model, 0).empty());
  model.levers.clear();
  const std::vector<EffectFault> faults = FaultsOfJoint(model, 0);
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0].mechanism, "learned");
  EXPECT_THAT(faults[0].finding, HasSubstr("shapes a commanded rate, but no lever"));
}

}  // namespace
}  // namespace tera
