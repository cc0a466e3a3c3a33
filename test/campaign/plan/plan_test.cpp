#include "campaign/plan/plan.h"

#include <gtest/gtest.h>

#include <set>

#include "campaign/campaign_files.h"
#include "core/faults.h"

namespace tera {
namespace {

namespace fs = std::filesystem;

std::string With(const std::string& lines) { return std::string(kSoils) + lines; }

TEST(Plan, AnEpisodeHasTheValuesOfItsPointAndASeedOfItsOwn) {
  const Plan plan = MakePlan(WriteCampaign(kSoils), OwnFolder() / "out");
  std::set<std::uint64_t> seeds;
  for (int number = 0; number < 4; ++number) {
    for (int draw = 0; draw < 3; ++draw) seeds.insert(EpisodeSeed(plan.campaign, number, draw));
  }
  EXPECT_EQ(seeds.size(), 12u);
  const LoadedScenario episode = EpisodeScenario(plan.campaign, 3, 0);
  EXPECT_NE(episode.resolved_yaml.find("soil: sand"), std::string::npos);
  EXPECT_EQ(episode.scenario.seed, EpisodeSeed(plan.campaign, 3, 0));
  EXPECT_NE(episode.scenario.drawn, EpisodeScenario(plan.campaign, 3, 1).scenario.drawn);
}

TEST(Plan, IsReadBackAndMayBeMadeAgain) {
  const fs::path campaign = WriteCampaign(kSoils), out = OwnFolder() / "out";
  const Plan plan = MakePlan(campaign, out);
  EXPECT_EQ(MakePlan(campaign, out).fingerprint, plan.fingerprint);
  const Plan read = LoadPlan(out);
  EXPECT_EQ(read.fingerprint, plan.fingerprint);
  EXPECT_EQ(read.campaign.scenario, plan.campaign.scenario);
  RequireSameScenario(read);
}

TEST(Plan, FactorsThatNameNoKeyAreFaultsAtTheirPlace) {
  const fs::path file = WriteCampaign(With("  - {key: terrain.sol, levels: [1, 2]}\n"));
  EXPECT_THAT([&] { MakePlan(file, OwnFolder() / "out"); },
              ThrowsFault(FaultKind::kUnknown, "campaign.yaml:6:11: factors[1].key"));
  EXPECT_FALSE(fs::exists(OwnFolder() / "out"));
}

TEST(Plan, RulesThatNoEpisodeCanMeetAreFound) {
  const auto expect_fault = [](const std::string& rule) {
    const fs::path file = WriteCampaign(With("accept:\n  - {name: r, " + rule + "}\n"));
    EXPECT_THAT([&] { MakePlan(file, OwnFolder() / "out"); },
                ThrowsFault(FaultKind::kNoSuchName, "campaign.yaml:7:5: accept[0]"))
        << rule;
  };
  expect_fault("seen: person, at_least: 0.05");
  expect_fault("table: truth/rover1/joints.csv, column: bucket_soil_kg, at_least: 1");
  expect_fault("tilt_deg_of: rover2, at_most: 30");
}

TEST(Plan, FaultsOfTheFileAreToldTogether) {
  const fs::path file = WriteCampaign(
      "name: soils\nscenario: resting.yaml\nepisodes: 3\n"
      "factors:\n  - {key: terrain.soil, levels: [dirt, sand]}\n"
      "  - {key: duration_s, range: [1, 2]}\n"
      "accept: [{name: r, seen: persn, at_least: 2}]\nsplits: {shares: {train: 0.5}}\n");
  const auto faults = FaultsIn([&] { MakePlan(file, OwnFolder() / "out"); });
  EXPECT_THAT(faults, HasFault(FaultKind::kInconsistent, "episodes"));
  EXPECT_THAT(faults, HasFault(FaultKind::kInconsistent, "factors[1].range"));
  EXPECT_THAT(faults, HasFault(FaultKind::kNoSuchName, "accept[0].seen"));
  EXPECT_THAT(faults, HasFault(FaultKind::kOutOfRange, "accept[0].at_least"));
  EXPECT_THAT(faults, HasFault(FaultKind::kOutOfRange, "splits.shares"));
}

TEST(Plan, AFolderOfAnotherCampaignIsRefused) {
  const fs::path out = OwnFolder() / "out";
  MakePlan(WriteCampaign(kSoils), out);
  const fs::path other = WriteCampaign(With("seed: 2\n"));
  EXPECT_THAT([&] { MakePlan(other, out); }, ThrowsFault(FaultKind::kInconsistent, "out"));
}

TEST(Plan, AnotherVersionAndAChangedScenarioAreRefused) {
  const fs::path out = OwnFolder() / "out";
  const Plan plan = MakePlan(WriteCampaign(kSoils), out);
  WriteCampaign(kSoils, std::string(kRestingRover) + "physics_rate_hz: 400\n");
  EXPECT_THAT([&] { RequireSameScenario(plan); },
              ThrowsFault(FaultKind::kInconsistent, "resting.yaml"));
  WriteWholeFile(out / "plan.yaml",
                 "tera_version: \"0.0.1\"\nfingerprint: \"x\"\nfolder: \"/tmp\"\n");
  EXPECT_THAT([&] { LoadPlan(out); }, ThrowsFault(FaultKind::kInconsistent, "plan.yaml"));
}

}  // namespace
}  // namespace tera
