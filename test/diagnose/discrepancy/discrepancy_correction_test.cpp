#include "diagnose/discrepancy/discrepancy_correction.h"

#include <gtest/gtest.h>

#include "diagnose/search/block/block_diagnosis.h"
#include "diagnose/search/toy_block.h"

namespace tera {
namespace {

constexpr std::size_t kSize = 6000;
constexpr double kNoise = 0.05;

/// A toy whose replay lacks 0.3 of the lever's square, which the simulation has. The recording has
/// `amount` of it, and a `step` of which neither knows.
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

using Names = std::vector<std::string>;

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
