#include "diagnose/diagnosis.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "diagnose/report/made_diagnosis.h"

namespace tera {
namespace {

using ::testing::ElementsAre;

/// Play that removes nearly all of the error in few manoeuvres, and a dead band that gains slightly
/// in very many.
DiagnosedBlock LoudInFewAndFaintInMany() {
  DiagnosedBlock boom = BoomWithDeadBand();
  boom.diagnosis.confirmed = {{0, 3 * kDeg, 0.5 * kDeg, 0.97, 1e-5}};
  boom.diagnosis.findings.push_back(boom.diagnosis.findings[0]);
  Finding& faint = boom.diagnosis.findings[0];
  faint.evidence.share = 0.7;
  faint.held_out = {0, 0.6 * kDeg, 0.5 * kDeg, 0.01, 1e-6};
  Finding& play = boom.diagnosis.findings[1];
  play.term = {&boom.block.candidates[2], {0.01}};
  play.evidence.share = 0.3;
  play.held_out = {0, 2.9 * kDeg, 0.5 * kDeg, 0.97, 1e-4};
  return boom;
}

std::vector<std::string> TargetsAndNames(const Diagnosis& diagnosis) {
  std::vector<std::string> names;
  for (const Cause& cause : RankedCauses(diagnosis)) {
    names.push_back(cause.block->block.name + " " + std::string(cause.mechanism().id));
  }
  return names;
}

TEST(Ranking, WhatRemovesMostOfTheErrorComesFirstThoughItsLikelihoodGainsLess) {
  const Diagnosis diagnosis = Of(LoudInFewAndFaintInMany());
  EXPECT_THAT(TargetsAndNames(diagnosis), ElementsAre("boom backlash", "boom dead_band"));
}

TEST(Ranking, OfBlocksTheOneWhoseFindingsAreLikeliestComesFirst) {
  Diagnosis diagnosis = Of(LoudInFewAndFaintInMany());
  diagnosis.blocks.push_back(BoomWithDeadBand());
  diagnosis.blocks.back().block.name = "arm";
  EXPECT_EQ(TargetsAndNames(diagnosis).front(), "boom backlash");
  diagnosis.blocks.back().diagnosis.search.flexible_gain = 5000;
  EXPECT_EQ(TargetsAndNames(diagnosis).front(), "arm dead_band");
}

}  // namespace
}  // namespace tera
