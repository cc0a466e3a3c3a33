#include "diagnose/perception/registration/sensor_candidates.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "sensors/sensor_mechanisms.h"

namespace tera {
namespace {

using ::testing::ElementsAre;

std::vector<std::string_view> IdsOf(const std::vector<Candidate>& candidates) {
  std::vector<std::string_view> ids;
  for (const Candidate& one : candidates) ids.push_back(one.mechanism->id);
  return ids;
}

const Mechanism& Known(std::string_view id, EffectTarget target) {
  return *std::find_if(SensorMechanisms().begin(), SensorMechanisms().end(),
                       [&](const Mechanism& one) { return one.id == id && one.ActsOn(target); });
}

TEST(SensorCandidates, AreTheMechanismsOfTheSensorsTableThatActOnItsKind) {
  const auto of_lidar = CandidatesOf(EffectTarget::kLidar, ComparedBy::kRanges, "roof", {});
  const auto of_depth = CandidatesOf(EffectTarget::kCamera, ComparedBy::kRanges, "front", {});
  const auto of_colour = CandidatesOf(EffectTarget::kCamera, ComparedBy::kPictures, "side", {});
  EXPECT_THAT(IdsOf(of_lidar), ElementsAre("extrinsic", "range_bias", "scale", "clock_offset"));
  EXPECT_THAT(IdsOf(of_depth), ElementsAre("extrinsic", "range_bias", "scale", "clock_offset"));
  EXPECT_THAT(IdsOf(of_colour), ElementsAre("extrinsic", "clock_offset"));
  for (const Candidate& one : of_lidar) {
    EXPECT_EQ(one.mechanism, &Known(one.mechanism->id, EffectTarget::kLidar));
    EXPECT_EQ(one.target, "roof");
  }
  EXPECT_EQ(of_lidar[1].mechanism->parameters[0].name, "range_m");
  EXPECT_EQ(of_depth[1].mechanism->parameters[0].name, "depth_m");
}

TEST(SensorCandidates, FreeAllParametersInTheRangesOfTheTableWithAPrior) {
  for (const Candidate& one : CandidatesOf(EffectTarget::kLidar, ComparedBy::kRanges, "roof", {})) {
    const auto& parameters = one.mechanism->parameters;
    ASSERT_EQ(one.free.size(), parameters.size()) << one.mechanism->id;
    for (const FreeParameter& free : one.free) {
      EXPECT_EQ(free.lower, parameters[free.index].lower);
      EXPECT_EQ(free.upper, parameters[free.index].upper);
      EXPECT_GT(free.prior_sigma, 0);
      EXPECT_LT(free.prior_sigma, free.upper - free.lower);
    }
  }
}

TEST(SensorCandidates, BeginWhereTheMechanismDoesNothing) {
  for (const Candidate& one : CandidatesOf(EffectTarget::kLidar, ComparedBy::kRanges, "roof", {})) {
    const double ideal = one.mechanism->id == "scale" ? 1 : 0;
    for (const double value : one.starts.front()) EXPECT_EQ(value, ideal) << one.mechanism->id;
  }
}

TEST(SensorCandidates, ThatTheScenarioHasAlreadyKnowTheirPresentNumbers) {
  const Effects present = {{&Known("range_bias", EffectTarget::kLidar), {0.2}}};
  const auto candidates = CandidatesOf(EffectTarget::kLidar, ComparedBy::kRanges, "roof", present);
  EXPECT_THAT(candidates[1].present, ElementsAre(0.2));
  EXPECT_TRUE(candidates[0].present.empty());
}

}  // namespace
}  // namespace tera
