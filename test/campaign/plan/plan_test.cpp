#include "campaign/plan/plan.h"

#include <gmock/gmock.h>
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
  RequireSameScenario(read, 0);
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
  expect_fault("seen: person, at_most: 0.05, camera: rover1/fornt");
  expect_fault("table: truth/walker/pose.csv, column: x_m, at_most: 3");
}

TEST(Plan, ARuleMayAskForThePoseOfAnObstacle) {
  const std::string scenario = std::string(kRestingRover) +
                               "record: {poses_hz: 10}\n"
                               "obstacles: [{name: walker, preset: "
                               "'tera:config/obstacles/person_standing.yaml', xy_m: [4, 0], path: "
                               "[{t_s: 0, xy_m: [4, 0]}, {t_s: 9, xy_m: [4, 3]}]}]\n";
  MakePlan(WriteCampaign(With("accept: [{name: r, table: truth/walker/pose.csv, column: x_m, "
                              "at_most: 5}]\n"),
                         scenario),
           OwnFolder() / "out");
}

TEST(Plan, TheWorkingFolderStaysWhereItIs) {
  const fs::path before = fs::current_path(), out = OwnFolder() / "out";
  WriteWholeFile(OwnFolder() / "rig.yaml", "sensors: []\n");
  const Plan plan =
      MakePlan(WriteCampaign(With("  - {key: 'machines[0].rig', levels: [rig.yaml]}\n")), out);
  EXPECT_EQ(fs::current_path(), before);
  EXPECT_TRUE(EpisodeScenario(LoadPlan(out).campaign, 0, 0).scenario.machines[0].sensors.empty());
  EXPECT_EQ(fs::current_path(), before);
}

TEST(Plan, AChangedFileThatALevelNamesMakesAnotherCampaign) {
  const fs::path out = OwnFolder() / "out";
  WriteWholeFile(OwnFolder() / "one.yaml", "sensors: []\n");
  WriteWholeFile(OwnFolder() / "other.yaml", "sensors: []\n");
  const fs::path campaign =
      WriteCampaign(With("  - {key: 'machines[0].rig', levels: [one.yaml, other.yaml]}\n"));
  const Plan plan = MakePlan(campaign, out);  // the rigs take turns, each under both soils
  RequireSameScenario(plan, 1);
  WriteWholeFile(OwnFolder() / "other.yaml", R"(sensors: [{name: imu, link: chassis, rate_hz: 50,
    preset: tera:config/sensors/xsens_mti_670.yaml}])");
  RequireSameScenario(plan, 0);
  EXPECT_THAT([&] { RequireSameScenario(plan, 1); },
              ThrowsFault(FaultKind::kInconsistent, "campaign.yaml:6:11: factors[1].key"));
  EXPECT_THAT([&] { MakePlan(campaign, out); }, ThrowsFault(FaultKind::kInconsistent, "out"));
}

// Sobol's first point, 1/2 in each dimension, has the second of two levels of each factor.
TEST(Plan, ALevelThatFitsNoFirstValuesIsPlannedInItsOwnEpisode) {
  WriteWholeFile(OwnFolder() / "boom.yaml", R"(sensors: [{name: imu, link: boom, rate_hz: 50,
    preset: tera:config/sensors/xsens_mti_670.yaml}])");
  WriteWholeFile(OwnFolder() / "none.yaml", "sensors: []\n");
  const Plan plan = MakePlan(
      WriteCampaign("name: rigs\nscenario: resting.yaml\ndesign: sobol\nepisodes: 1\nfactors:\n"
                    "  - {key: 'machines[0].machine', levels: [tera:config/machines/warthog.yaml, "
                    "tera:config/machines/excavator20t.yaml]}\n"
                    "  - {key: 'machines[0].rig', levels: [none.yaml, boom.yaml]}\n"),
      OwnFolder() / "out");
  RequireSameScenario(plan, 0);
  EXPECT_EQ(plan.level_digests.size(), 2u);
  WriteWholeFile(OwnFolder() / "boom.yaml", "sensors: []\n");
  EXPECT_THAT([&] { RequireSameScenario(plan, 0); },
              ThrowsFault(FaultKind::kInconsistent, "factors[0].key"));
}

// RFC 4180: a field with a comma or a quote stands in quotes, its own quotes doubled.
TEST(Plan, ItsTableQuotesFields) {
  MakePlan(WriteCampaign("name: q\nscenario: resting.yaml\nfactors: [{key: name, levels: "
                         "['a \"b\", c']}]\n"),
           OwnFolder() / "out");
  const std::string csv = ReadWholeFile(OwnFolder() / "out/episodes.csv");
  EXPECT_THAT(csv, testing::EndsWith(R"(,"a ""b"", c")"
                                     "\n"));
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
  EXPECT_THAT([&] { RequireSameScenario(plan, 0); },
              ThrowsFault(FaultKind::kInconsistent, "resting.yaml"));
  WriteWholeFile(out / "plan.yaml",
                 "tera_version: \"0.0.1\"\nfingerprint: \"x\"\nfolder: \"/tmp\"\n");
  EXPECT_THAT([&] { LoadPlan(out); }, ThrowsFault(FaultKind::kInconsistent, "plan.yaml"));
}

}  // namespace
}  // namespace tera
