#include "diagnose/discrepancy/discrepancy_correction.h"

#include <gtest/gtest.h>

#include <cmath>

#include "diagnose/blocks/base_block.h"
#include "diagnose/search/block/block_diagnosis.h"
#include "diagnose/search/toy_block.h"
#include "sim/drive_fixture.h"

namespace tera {
namespace {

using Names = std::vector<std::string>;

/// Tracks that turn in one direction, then in the other, for 24 s.
NamedLevers ToAndFro(double t_s) {
  const double turn = 0.5 * std::sin(0.8 * t_s);
  return {{"left_track", 0.3 + turn}, {"right_track", 0.3 - turn}};
}

/// A drive as a simulation, and as error-free encoders and poses.
struct Driven {
  Drive drive;
  SimulatedCourse course;
  NamedEncoders encoders{"m/tracks", {}};
  std::vector<TruthPose> poses;

  explicit Driven(const std::string& ground)
      : drive("tb235.yaml", "{xy_m: [-6, -3], yaw_deg: 25}", "cell_m: 0.1, soil: dirt", 0, 0,
              "    ground: " + ground + "\n") {
    drive.Operate(ToAndFro);
    for (const RunningGear& gear : model().ground_tools.gears) {
      encoders.recording.axes.push_back({gear.name});
    }
    course.step_s = 1 / drive.scenario.physics_rate_hz;
    drive.Run(24, [&] { Keep(); });
  }
  const MachineModel& model() const { return drive.scenario.machines[0].placement.model; }
  void Keep() {
    const MachineState& state = drive.machine();
    const TimeNs t_ns = drive.simulation->state().t_ns;
    if (course.steps.empty()) course.zero_ns = t_ns;
    SimulatedCourse::Step step{state.q_rad, state.qd_radps, state.links[0].X_WB};
    for (std::size_t g = 0; g < state.gear_rate_radps.size(); ++g) {
      step.position_rad.push_back(state.gear_angle_rad[g]);
      step.rate_radps.push_back(state.gear_rate_radps[g]);
    }
    course.steps.push_back(std::move(step));
    if (t_ns % (kNsPerSecond / 100) != 0) return;
    encoders.recording.samples.push_back(
        {.t_ns = t_ns, .q_rad = state.gear_angle_rad, .qd_radps = state.gear_rate_radps});
    poses.push_back({.t_ns = t_ns, .X_WB = state.links[0].X_WB});
  }
  BaseLog Log() const { return MakeBaseLog(model(), {encoders}, poses, 0.2); }
  BaseLog SimulatedLog() const {
    return MakeBaseLog(model(), AsSimulated(model(), course, {encoders}),
                       AsSimulated(course, poses), 0.2);
  }
};

TEST(MotionDiscrepancy, OnSoilTracksTurnTheMachineLessThanTheirKinematicsSay) {
  const Driven driven("terramechanics");
  const BaseLog log = driven.Log();
  const auto left = MotionDiscrepancy(driven.model(), log, driven.SimulatedLog());
  ASSERT_EQ(left.size(), 3u);
  const auto block = MakeBaseBlock(driven.model(), log, "m/base", false);
  ASSERT_TRUE(block);
  const auto replayed = block->predict({});
  double with = 0, without = 0, against = 0;
  for (std::size_t k = 0; k < block->samples(); ++k) {
    const double measured = block->channels[2].measured.value[k];
    without += std::pow(measured - replayed[2][k], 2);
    with += std::pow(measured - replayed[2][k] - left[2][k], 2);
    against += left[2][k] * replayed[2][k];
  }
  EXPECT_LT(against, 0);
  EXPECT_GT(std::sqrt(without / static_cast<double>(block->samples())), 0.03);
  EXPECT_LT(with, 1e-6 * without);
}

TEST(MotionDiscrepancy, OfTracksThatNeitherSlipNorSkidHardlyAnythingIsLeft) {
  const Driven driven("kinematic");
  for (const auto& channel :
       MotionDiscrepancy(driven.model(), driven.Log(), driven.SimulatedLog())) {
    double square = 0;
    for (const double x : channel) square += x * x;
    EXPECT_LT(std::sqrt(square / static_cast<double>(channel.size())), 0.01);
  }
}

TEST(MotionDiscrepancy, BeyondTheEndOfTheSimulationNothingIsLeft) {
  Driven driven("terramechanics");
  const TimeNs end_ns = driven.course.zero_ns + 12 * kNsPerSecond;
  driven.course.steps.resize(driven.course.steps.size() / 2);
  const BaseLog log = driven.Log();
  const auto left = MotionDiscrepancy(driven.model(), log, driven.SimulatedLog());
  double early = 0;
  for (std::size_t i = 0; i < log.intervals.size(); ++i) {
    if (log.intervals[i].to_ns > end_ns) {
      EXPECT_EQ(left[2][i], 0) << i;
    } else {
      early += std::abs(left[2][i]);
    }
  }
  EXPECT_GT(early, 0.1);
}

constexpr std::size_t kSize = 6000;
constexpr double kNoise = 0.05;

/// A toy whose simulation has 0.3 of the lever's square, which its replay lacks. The recording has
/// `amount` of it, and a `step` that both lack.
struct Lacking {
  std::vector<double> lever = ToyLever(kSize, 7);
  ReplayDiscrepancy square{"toy/rate", {std::vector<double>(kSize)}};
  ReplayBlock block;

  explicit Lacking(double amount, double step = 0) {
    for (std::size_t k = 0; k < kSize; ++k) square.channels[0][k] = 0.3 * lever[k] * lever[k];
    const auto clean = ToyResponse(lever, 0.3 * amount, step, 0);
    block = ToyBlock(lever, ToyMeasured(clean, kNoise, 11), {0, 2});
  }
  DiscrepancyCorrection Correct() {
    return CorrectDiscrepancy(square, Stream(1, "toy"), &block).at(0);
  }
  std::vector<std::string> Found() const {
    const BlockDiagnosis diagnosis = DiagnoseBlock(block, {}, Stream(1, "toy"));
    std::vector<std::string> found;
    for (const Finding& finding : diagnosis.findings) {
      found.emplace_back(finding.term.candidate->mechanism->id);
    }
    for (const Unexplained& left : diagnosis.unexplained) {
      found.push_back("unexplained in " + block.channels[left.location.channel].name);
    }
    return found;
  }
};

TEST(CorrectDiscrepancy, WhatTheSimulationHasAndTheReplayLacksIsNoFindingAnyMore) {
  Lacking toy(1);
  EXPECT_EQ(toy.Found(), Names{"square"});
  const DiscrepancyCorrection correction = toy.Correct();
  EXPECT_TRUE(correction.is_applied());
  EXPECT_TRUE(correction.is_simulated);
  EXPECT_EQ(correction.channel, "toy/rate");
  EXPECT_GT(correction.rms, 0.03);
  EXPECT_EQ(toy.Found(), Names{});
}

TEST(CorrectDiscrepancy, AThirdLessOfItIsNoFindingEither) {
  Lacking toy(0.67);
  EXPECT_EQ(toy.Found(), Names{"square"});
  toy.Correct();
  EXPECT_EQ(toy.Found(), Names{});
}

TEST(CorrectDiscrepancy, WhatNeitherHasIsFoundBesideIt) {
  Lacking toy(1, 0.4);
  toy.Correct();
  EXPECT_EQ(toy.Found(), Names{"step"});
}

// A long recording's prefix is searched first.
TEST(CorrectDiscrepancy, IsInAPrefixToo) {
  Lacking toy(1);
  const auto before = toy.block.replay({}, 1000)[0];
  ASSERT_TRUE(toy.Correct().is_applied());
  const auto after = toy.block.replay({}, 1000)[0];
  ASSERT_EQ(after.size(), 1000u);
  for (std::size_t k = 0; k < 1000; ++k) {
    EXPECT_EQ(after[k], before[k] + toy.square.channels[0][k]);
  }
}

TEST(CorrectDiscrepancy, WhatTheRecordingDoesNotShowStays) {
  Lacking toy(0);
  const auto before = toy.block.predict({});
  EXPECT_FALSE(toy.Correct().is_applied());
  EXPECT_EQ(toy.block.predict({}), before);
  EXPECT_EQ(toy.block.channels[0].nominal.cols(), 0);
  EXPECT_EQ(toy.Found(), Names{});
}

}  // namespace
}  // namespace tera
