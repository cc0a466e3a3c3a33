#include "diagnose/tolerances/within_tolerance.h"

#include <gtest/gtest.h>

#include <array>
#include <set>

#include "diagnose/search/structure/expected_beside.h"
#include "diagnose/tolerances/default_tolerances.h"
#include "physics/actuation/actuation_mechanisms.h"
#include "physics/traction/ground_mechanisms.h"
#include "sensors/sensor_mechanisms.h"

namespace tera {
namespace {

const Mechanism& MechanismOf(std::string_view id, EffectTarget target) {
  for (const auto library : {ActuationMechanisms(), GroundMechanisms(), SensorMechanisms()}) {
    for (const Mechanism& mechanism : library) {
      if (mechanism.id == id && mechanism.ActsOn(target)) return mechanism;
    }
  }
  throw std::runtime_error(std::string(id));
}

/// A block with this mechanism as its only candidate, with all parameters free.
std::vector<ReplayBlock> BlockOf(const Mechanism& mechanism, const std::string& target) {
  Candidate candidate{.mechanism = &mechanism, .target = target};
  for (std::size_t i = 0; i < mechanism.parameters.size(); ++i) candidate.free.push_back({i});
  std::vector<ReplayBlock> blocks(1);
  blocks[0].candidates = {candidate};
  return blocks;
}

Finding FindingOf(const ReplayBlock& block, std::vector<double> values,
                  const std::vector<std::optional<double>>& sigmas) {
  Finding finding;
  finding.term = {&block.candidates[0], values};
  for (std::size_t i = 0; i < values.size(); ++i) {
    finding.parameters.push_back({"", "", values[i], sigmas[i]});
  }
  return finding;
}

// The tolerance of a dead band is 0.02. 95 % of a posterior of sigma 0.01 exceed it from 0.02 +
// 1.645 * 0.01 = 0.0364 on.
TEST(Tolerance, IsExceededWhereNineteenOfTwentyPartsOfThePosteriorLieBeyond) {
  auto blocks = BlockOf(MechanismOf("dead_band", EffectTarget::kJoint), "boom");
  StateTolerances({}, &blocks);
  EXPECT_FALSE(IsBeyondTolerance(FindingOf(blocks[0], {0.036, 0}, {0.01, std::nullopt})));
  EXPECT_TRUE(IsBeyondTolerance(FindingOf(blocks[0], {0.037, 0}, {0.01, std::nullopt})));
}

TEST(Tolerance, LiesOnBothSidesOfTheNumberWithoutEffect) {
  auto blocks = BlockOf(MechanismOf("rate_gain", EffectTarget::kJoint), "boom");
  StateTolerances({}, &blocks);
  EXPECT_TRUE(IsBeyondTolerance(FindingOf(blocks[0], {0.9}, {0.01})));
  EXPECT_TRUE(IsBeyondTolerance(FindingOf(blocks[0], {1.1}, {0.01})));
  EXPECT_FALSE(IsBeyondTolerance(FindingOf(blocks[0], {0.95}, {0.001})));
}

// A rate 14 % too high, known to 0.2 % by the data, and its effect to a twentieth. 0.14 - 1.645 *
// 0.0073 exceeds 0.06, although the parameter itself has a sigma of 0.057.
TEST(Tolerance, OfAFactorIsHeldAgainstWhatItDiffersByFromOne) {
  auto blocks = BlockOf(MechanismOf("rate_gain", EffectTarget::kJoint), "boom");
  StateTolerances({}, &blocks);
  Finding finding = FindingOf(blocks[0], {1.14}, {0.057});
  EXPECT_FALSE(IsBeyondTolerance(finding));
  finding.parameters[0].effect_sigma = 0.0073;
  EXPECT_TRUE(IsBeyondTolerance(finding));
}

TEST(Tolerance, LiesAboutTheNumberThatTheScenarioHas) {
  auto blocks = BlockOf(MechanismOf("dead_band", EffectTarget::kJoint), "boom");
  blocks[0].candidates[0].present = {0.15, 0};
  StateTolerances({}, &blocks);
  EXPECT_FALSE(IsBeyondTolerance(FindingOf(blocks[0], {0.14, 0}, {0.001, std::nullopt})));
  EXPECT_TRUE(IsBeyondTolerance(FindingOf(blocks[0], {0.05, 0}, {0.001, std::nullopt})));
}

TEST(Tolerance, OfTheOwnerStandsOverTheDefaultForItsTargetAlone) {
  const Mechanism& mount = MechanismOf("mount_rotation", EffectTarget::kImu);
  const Tolerances stated = {{"imu_boom", &mount, 0, 3.0}};
  auto blocks = BlockOf(mount, "imu_boom"), others = BlockOf(mount, "imu_arm");
  StateTolerances(stated, &blocks);
  StateTolerances(stated, &others);
  const std::vector<std::optional<double>> sigmas(3, 0.1);
  EXPECT_FALSE(IsBeyondTolerance(FindingOf(blocks[0], {2, 0, 0}, sigmas)));
  EXPECT_TRUE(IsBeyondTolerance(FindingOf(blocks[0], {0, 2, 0}, sigmas)));
  EXPECT_TRUE(IsBeyondTolerance(FindingOf(others[0], {2, 0, 0}, sigmas)));
}

// A parameter at an end of its range, or undetermined by the data, has no standard deviation.
TEST(Tolerance, IsNotExceededByANumberThatIsNotDetermined) {
  auto blocks = BlockOf(MechanismOf("latency", EffectTarget::kImu), "imu_boom");
  StateTolerances({}, &blocks);
  EXPECT_FALSE(IsBeyondTolerance(FindingOf(blocks[0], {3, 0}, {std::nullopt, std::nullopt})));
  Finding held = FindingOf(blocks[0], {3, 0}, {0.001, std::nullopt});
  EXPECT_TRUE(IsBeyondTolerance(held));
  held.term.held = {0};
  EXPECT_FALSE(IsBeyondTolerance(held));
}

// A latency of 3 s at the end of its range may be larger.
TEST(Tolerance, LeavesWhatIsNotDeterminedAndLiesBeyondUnconfirmed) {
  auto blocks = BlockOf(MechanismOf("latency", EffectTarget::kImu), "imu_boom");
  StateTolerances({}, &blocks);
  BlockDiagnosis diagnosis;
  diagnosis.findings = {FindingOf(blocks[0], {3, 0}, {std::nullopt, std::nullopt}),
                        FindingOf(blocks[0], {0.01, 0}, {std::nullopt, std::nullopt})};
  MoveExpected(&diagnosis);
  EXPECT_TRUE(diagnosis.findings.empty());
  ASSERT_EQ(diagnosis.unconfirmed.size(), 1u);
  EXPECT_EQ(diagnosis.unconfirmed[0].term.values[0], 3);
  EXPECT_EQ(diagnosis.within_tolerance.size(), 1u);
}

TEST(Tolerance, IsExceededByAnyActOfWhatNothingIsStatedOf) {
  auto blocks = BlockOf(MechanismOf("axis_flip", EffectTarget::kImu), "imu_boom");
  StateTolerances({}, &blocks);
  EXPECT_TRUE(IsBeyondTolerance(FindingOf(blocks[0], {1, 0, 0}, {{}, {}, {}})));
}

TEST(Tolerance, WhatIsWithinLeavesTheFindingsAndKeepsItsNumbers) {
  auto blocks = BlockOf(MechanismOf("rate_gain", EffectTarget::kJoint), "boom");
  StateTolerances({}, &blocks);
  BlockDiagnosis diagnosis;
  diagnosis.findings = {FindingOf(blocks[0], {0.97}, {0.002}), FindingOf(blocks[0], {0.8}, {0.01})};
  MoveExpected(&diagnosis);
  ASSERT_EQ(diagnosis.findings.size(), 1u);
  EXPECT_EQ(diagnosis.findings[0].term.values[0], 0.8);
  ASSERT_EQ(diagnosis.within_tolerance.size(), 1u);
  EXPECT_EQ(diagnosis.within_tolerance[0].term.values[0], 0.97);
}

/// A finding without any stated tolerance that changes an RMS from `before` to `after`.
Finding FindingThatTakes(const ReplayBlock& block, double before, double after, double tolerated) {
  Finding finding = FindingOf(block, {20, 0.3, 0}, {1, {}, {}});
  finding.held_out.rmse_before = before;
  finding.held_out.rmse_after = after;
  finding.tolerated = tolerated;
  return finding;
}

// From 0.0299 to 0.0285 rad/s it explains sqrt(0.0299^2 - 0.0285^2) = 0.00904 rad/s.
TEST(Tolerance, WhatTakesLessThanAFactorWithinItsToleranceLeavesIsNotTold) {
  auto blocks = BlockOf(MechanismOf("structural_flex", EffectTarget::kJoint), "boom");
  StateTolerances({}, &blocks);
  EXPECT_FALSE(IsBeyondTolerance(FindingThatTakes(blocks[0], 0.0299, 0.0285, 0.0091)));
  EXPECT_TRUE(IsBeyondTolerance(FindingThatTakes(blocks[0], 0.0299, 0.0285, 0.0090)));
  EXPECT_TRUE(IsWithinTolerance(FindingThatTakes(blocks[0], 0.0299, 0.0285, 0.0091)));
  EXPECT_FALSE(IsBeyondTolerance(FindingThatTakes(blocks[0], 0.0285, 0.0299, 0.0010)));
}

// From 0.0299 to 0.0285 rad/s. The expected deviation explains the part down to 0.0290: 0.00536
// remains.
TEST(Tolerance, IsAskedBeyondWhatIsExpectedInTheFindingsPlace) {
  auto blocks = BlockOf(MechanismOf("structural_flex", EffectTarget::kJoint), "boom");
  StateTolerances({}, &blocks);
  Finding finding = FindingThatTakes(blocks[0], 0.0299, 0.0285, 0.0054);
  EXPECT_TRUE(IsBeyondTolerance(finding));
  finding.as_expected = {0.0290, 0};
  EXPECT_FALSE(IsBeyondTolerance(finding));
  EXPECT_TRUE(IsWithinTolerance(finding));
  finding.tolerated = 0.0053;
  EXPECT_TRUE(IsBeyondTolerance(finding));
  // 0.0290^2 - 0.0285^2 = 2.875e-5; 1.645 times 1e-6 less is 0.00520^2.
  finding.as_expected = {0.0290, 1e-6};
  EXPECT_FALSE(IsBeyondTolerance(finding));
  finding.tolerated = 0.0051;
  EXPECT_TRUE(IsBeyondTolerance(finding));
}

TEST(Tolerance, OfARivalThatDoesAsWellHoldsForTheFinding) {
  auto blocks = BlockOf(MechanismOf("structural_flex", EffectTarget::kJoint), "boom");
  StateTolerances({}, &blocks);
  Finding finding = FindingThatTakes(blocks[0], 0.03, 0.01, 0.001);
  EXPECT_TRUE(IsBeyondTolerance(finding));
  finding.evidence.expected_rivals = {&blocks[0].candidates[0]};
  EXPECT_FALSE(IsBeyondTolerance(finding));
  EXPECT_TRUE(IsWithinTolerance(finding));
}

// With the rival and all other expected deviations, 0.0102 rad/s remain: sqrt(0.0102^2 - 0.01^2) =
// 0.00201 more than the finding leaves. Or 0.02: 0.0173 more.
TEST(Tolerance, OfARivalIsHeldAgainstTheErrorThatItLeaves) {
  auto blocks = BlockOf(MechanismOf("structural_flex", EffectTarget::kJoint), "boom");
  StateTolerances({}, &blocks);
  const Candidate rival;
  Finding finding = FindingThatTakes(blocks[0], 0.03, 0.01, 0.0021);
  finding.evidence.rivals = {finding.term.candidate, &rival};
  finding.evidence.expected_rivals = {&rival};
  finding.as_expected = {0.0102, 0};
  EXPECT_TRUE(IsExplainedAsExpected(finding));
  EXPECT_TRUE(IsWithinTolerance(finding));
  finding.as_expected = {0.02, 0};
  EXPECT_FALSE(IsExplainedAsExpected(finding));
  EXPECT_TRUE(IsBeyondTolerance(finding));
  BlockDiagnosis diagnosis;
  diagnosis.findings = {finding};
  MoveExpected(&diagnosis);
  ASSERT_EQ(diagnosis.findings.size(), 1u);
  EXPECT_EQ(diagnosis.findings[0].evidence.rivals.size(), 1u) << "what is as expected is no name";
}

TEST(Tolerance, OfABlockWithoutFactorsAsksForNoSize) {
  auto blocks = BlockOf(MechanismOf("structural_flex", EffectTarget::kJoint), "boom");
  StateTolerances({}, &blocks);
  EXPECT_TRUE(IsBeyondTolerance(FindingThatTakes(blocks[0], 0.0299, 0.0298, 0)));
}

TEST(Tolerance, ThatABlockStatesItselfStandsUnlessTheOwnerStatesAnother) {
  const Mechanism& friction = MechanismOf("drive_friction", EffectTarget::kJoint);
  auto blocks = BlockOf(friction, "slew");
  blocks[0].candidates[0].free[0].expected = Expected{0, 0.018};  // a fiftieth of 0.9 rad/s
  StateTolerances({}, &blocks);
  const std::vector<std::optional<double>> sigmas{0.001, {}, {}, {}};
  EXPECT_FALSE(IsBeyondTolerance(FindingOf(blocks[0], {0.0168, 0.02, 1, 0.02}, sigmas)));
  EXPECT_TRUE(IsBeyondTolerance(FindingOf(blocks[0], {0.0200, 0.02, 1, 0.02}, sigmas)));
  StateTolerances({{.target = "slew", .mechanism = &friction, .parameter = 0, .half_width = 0.01}},
                  &blocks);
  EXPECT_TRUE(IsBeyondTolerance(FindingOf(blocks[0], {0.0168, 0.02, 1, 0.02}, sigmas)));
}

// A drive that responds 0.18 s late is slower than expected, regardless of its small friction.
TEST(Tolerance, OfALagHoldsWhereFrictionHasTheLag) {
  auto blocks = BlockOf(MechanismOf("drive_friction", EffectTarget::kJoint), "slew");
  blocks[0].candidates[0].free.push_back({.index = 1, .upper = 0.5});
  blocks[0].candidates[0].free[0].expected = Expected{0, 0.018};
  StateTolerances({}, &blocks);
  const std::vector<std::optional<double>> sigmas{0.001, 0.01, {}, {}};
  EXPECT_TRUE(IsBeyondTolerance(FindingOf(blocks[0], {0.005, 0.18, 1, 0.02}, sigmas)));
  EXPECT_FALSE(IsBeyondTolerance(FindingOf(blocks[0], {0.005, 0.03, 1, 0.02}, sigmas)));
}

// In a lever log at 10 Hz, each change is known to 0.05 s.
TEST(Tolerance, OfADelayHoldsBesideWhatTheLogOfALeverTells) {
  const std::vector<std::optional<double>> sigmas = {0.001, {}};
  for (const std::string_view id : {"actuator_lag", "command_delay"}) {
    auto blocks = BlockOf(MechanismOf(id, EffectTarget::kJoint), "arm");
    StateTolerances({}, &blocks);
    EXPECT_TRUE(IsBeyondTolerance(FindingOf(blocks[0], {0.08, 0}, sigmas))) << id;
    StateTolerances({}, &blocks, 0.1);
    EXPECT_FALSE(IsBeyondTolerance(FindingOf(blocks[0], {0.08, 0}, sigmas))) << id;
    EXPECT_TRUE(IsBeyondTolerance(FindingOf(blocks[0], {0.12, 0}, sigmas))) << id;
  }
  auto gain = BlockOf(MechanismOf("rate_gain", EffectTarget::kJoint), "arm");
  StateTolerances({}, &gain, 0.1);
  EXPECT_TRUE(IsBeyondTolerance(FindingOf(gain[0], {1.08}, {0.001})));
}

// The owner's tolerance of 0.04 s is of the sum of delays and lags from a lever to its joint. A lag
// of 0.03 s within tolerance leaves a delay 0.01 s. A lag of 0.15 s is a finding and uses nothing.
TEST(Tolerance, OfDelaysIsOneForAllDelaysOfACommand) {
  const Mechanism& lag = MechanismOf("actuator_lag", EffectTarget::kJoint);
  const Mechanism& delay = MechanismOf("command_delay", EffectTarget::kJoint);
  const Mechanism& band = MechanismOf("dead_band", EffectTarget::kJoint);
  std::vector<ReplayBlock> blocks(1);
  for (const Mechanism* one : {&lag, &delay, &band}) {
    Candidate candidate = BlockOf(*one, "boom")[0].candidates[0];
    for (FreeParameter& free : candidate.free) free.upper = 0.5;
    candidate.starts = {std::vector<double>(one->parameters.size(), 0.01)};
    blocks[0].candidates.push_back(candidate);
  }
  StateTolerances({}, &blocks);
  const auto longest_delay_s = [&](double lag_s) {
    const Term present{&blocks[0].candidates[0], {lag_s}};
    bool has_band = false;
    double longest_s = 0;
    for (const Candidate& one : ExpectedBeside(blocks[0], {present}, "boom")) {
      if (one.mechanism == &delay) longest_s = one.free.front().upper;
      has_band = has_band || one.mechanism == &band;
    }
    EXPECT_TRUE(has_band);
    return longest_s;
  };
  EXPECT_NEAR(longest_delay_s(0.001), 0.039, 1e-9);
  EXPECT_NEAR(longest_delay_s(0.03), 0.01, 1e-9);
  EXPECT_EQ(longest_delay_s(0.04), 0);
  EXPECT_NEAR(longest_delay_s(0.15), 0.04, 1e-9);
}

TEST(DefaultTolerances, AreOfParametersThatTheLibraryHas) {
  std::set<std::pair<std::string_view, std::string_view>> known;
  for (const auto library : {ActuationMechanisms(), GroundMechanisms(), SensorMechanisms()}) {
    for (const Mechanism& mechanism : library) {
      for (const EffectParameter& parameter : mechanism.parameters) {
        known.insert({mechanism.id, parameter.name});
      }
    }
  }
  std::set<std::array<std::string_view, 3>> seen;
  for (const DefaultTolerance& one : DefaultTolerances()) {
    EXPECT_TRUE(known.contains({one.mechanism, one.parameter})) << one.mechanism << one.parameter;
    EXPECT_TRUE(seen.insert({one.mechanism, one.parameter, one.target}).second) << one.mechanism;
    EXPECT_GT(one.half_width, 0) << one.mechanism;
  }
}

}  // namespace
}  // namespace tera
