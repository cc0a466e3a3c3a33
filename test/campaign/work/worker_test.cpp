#include "campaign/work/worker.h"

#include <gtest/gtest.h>

#include <chrono>
#include <new>

#include "campaign/campaign_files.h"
#include "campaign/work/episode_record.h"
#include "campaign/work/judge.h"
#include "core/faults.h"
#include "dataset/files/folder_lock.h"
#include "dataset/files/whole_folder.h"
#include "sim/run/generate.h"

namespace tera {
namespace {

namespace fs = std::filesystem;

std::string DigestOfEpisode(const Plan& plan, int number) {
  return ReadRecord(plan.EpisodeFolder(number) / "episode.yaml").sha256;
}

TEST(Worker, AnEpisodeHasTheSameBytesInAnyOrderWithAnyThreads) {
  const fs::path campaign = WriteCampaign(kSoils);
  const Plan first = MakePlan(campaign, OwnFolder() / "first"),
             second = MakePlan(campaign, OwnFolder() / "second");
  for (const int number : {0, 1}) RunEpisode(first, number, {.threads = 1});
  for (const int number : {1, 0}) RunEpisode(second, number, {.threads = 2});
  for (const int number : {0, 1}) {
    EXPECT_EQ(DigestOfEpisode(first, number), DigestOfEpisode(second, number));
  }
  EXPECT_NE(DigestOfEpisode(first, 0), DigestOfEpisode(first, 1));
}

TEST(Worker, AnEpisodeThatIsThereIsLeftAsItIs) {
  const Plan plan = MakePlan(WriteCampaign(kSoils), OwnFolder() / "out");
  RunEpisode(plan, 0, {});
  const auto written = fs::last_write_time(plan.EpisodeFolder(0) / "episode.yaml");
  RunEpisode(plan, 0, {});
  EXPECT_EQ(fs::last_write_time(plan.EpisodeFolder(0) / "episode.yaml"), written);
  EXPECT_TRUE(fs::is_empty(plan.folder / "work"));
}

TEST(Worker, RefusedDrawsAreCountedAndBounded) {
  // No tilt is below 0 and none of a rover at rest is above 45 deg: one bound refuses all draws,
  // the other none.
  const std::string rule = "redraws: 2\naccept: [{name: level, tilt_deg_of: rover1, at_most: ";
  const Plan strict =
      MakePlan(WriteCampaign(std::string(kSoils) + rule + "-1}]\n"), OwnFolder() / "strict");
  EXPECT_THAT([&] { RunEpisode(strict, 0, {}); },
              ThrowsFault(FaultKind::kInconsistent, "episode 0"));
  const Failure failure = ReadFailure(strict.FailureFile(0));
  EXPECT_EQ(failure.reason, FailureReason::kRefused);
  EXPECT_NE(failure.message.find("all 3 draws"), std::string::npos);
  EXPECT_FALSE(IsWorthRetry(failure.reason));
  EXPECT_FALSE(fs::exists(strict.EpisodeFolder(0)));

  const Plan lenient =
      MakePlan(WriteCampaign(std::string(kSoils) + rule + "45}]\n"), OwnFolder() / "lenient");
  RunEpisode(lenient, 0, {});
  EXPECT_TRUE(ReadRecord(lenient.EpisodeFolder(0) / "episode.yaml").refused.empty());
}

TEST(Worker, AnEpisodeThatAnotherWorkerMakesIsLeftToIt) {
  const Plan plan = MakePlan(WriteCampaign(kSoils), OwnFolder() / "out");
  MakeFolder(plan.WorkFolder(0));
  {
    const FolderLock lock(plan.WorkFolder(0));
    EXPECT_FALSE(RunEpisode(plan, 0, {}));
  }
  EXPECT_FALSE(fs::exists(plan.FailureFile(0)));
  EXPECT_TRUE(RunEpisode(plan, 0, {}));
}

/// Stops an episode before its last step. Returns its unfinished dataset.
fs::path StopAtTheEnd(const Plan& plan, int number) {
  const LoadedScenario loaded = EpisodeScenario(plan.campaign, number, 0);
  const fs::path dataset = plan.WorkFolder(number) / "draw_0/data";
  MakeFolder(dataset.parent_path());
  EXPECT_THROW(Generate(loaded.scenario, loaded.resolved_yaml,
                        {.out = dataset,
                         .progress =
                             [](const GenerateProgress&) {
                               throw InputError("here", {FaultKind::kUnwritable, "stopped"});
                             }}),
               InputError);
  return IncompleteOf(dataset);
}

TEST(Worker, AMissingDriverFailsNoEpisodeAndRemovesNothing) {
  std::string with_camera = kRestingRover;
  with_camera.replace(with_camera.find("rate_hz: 100}]"), 14,
                      "rate_hz: 100}, {name: front, preset: tera:config/sensors/rgb_640.yaml, "
                      "link: chassis, rate_hz: 10}]");
  const Plan plan = MakePlan(WriteCampaign(kSoils, with_camera), OwnFolder() / "out");
  const WorkerOptions without{.egl = {.device = 99}};
  EXPECT_THAT([&] { RunEpisode(plan, 0, without); }, ThrowsFault(FaultKind::kUnsupported));
  EXPECT_FALSE(fs::exists(plan.FailureFile(0)));
  const fs::path stopped = StopAtTheEnd(plan, 0);
  EXPECT_THAT([&] { RunEpisode(plan, 0, without); }, ThrowsFault(FaultKind::kUnsupported));
  EXPECT_FALSE(fs::exists(plan.FailureFile(0)));
  EXPECT_TRUE(fs::exists(stopped / "INCOMPLETE.frames"));
}

TEST(Worker, AnUnfinishedDatasetThatIsDamagedIsMadeAnew) {
  const Plan plan = MakePlan(WriteCampaign(kSoils), OwnFolder() / "out");
  WriteWholeFile(StopAtTheEnd(plan, 0) / "scenario.yaml", "damaged");
  EXPECT_TRUE(RunEpisode(plan, 0, {}));
  const Plan whole = MakePlan(OwnFolder() / "campaign.yaml", OwnFolder() / "whole");
  RunEpisode(whole, 0, {});
  EXPECT_EQ(DigestOfEpisode(plan, 0), DigestOfEpisode(whole, 0));
}

// A link to itself cannot be followed: an error that the file system throws.
TEST(Worker, AnErrorOfTheFileSystemFailsNoEpisode) {
  const Plan plan = MakePlan(WriteCampaign(kSoils), OwnFolder() / "out");
  const fs::path mark = plan.WorkFolder(0) / "draw_0.refused";
  MakeFolder(mark.parent_path());
  fs::create_symlink(mark.filename(), mark);
  EXPECT_THROW(RunEpisode(plan, 0, {}), fs::filesystem_error);
  EXPECT_FALSE(fs::exists(plan.FailureFile(0)));
  EXPECT_TRUE(fs::is_symlink(mark));
}

TEST(Worker, AFileThatADrawLacksFailsItsEpisodeAlone) {
  WriteWholeFile(OwnFolder() / "there.yaml", "sensors: []\n");
  WriteWholeFile(OwnFolder() / "gone.yaml", "sensors: []\n");
  const Plan plan = MakePlan(
      WriteCampaign("name: rigs\nscenario: resting.yaml\nepisodes: 8\n"
                    "randomise: [{key: 'machines[0].rig', choice: [there.yaml, gone.yaml]}]\n"),
      OwnFolder() / "out");
  fs::remove(OwnFolder() / "gone.yaml");
  int made = 0;
  for (int number = 0; number < 8; ++number) {
    try {
      RunEpisode(plan, number, {});
      ++made;
    } catch (const InputError& error) {
      EXPECT_EQ(ReadFailure(plan.FailureFile(number)).reason, FailureReason::kBadInput);
    }
  }
  EXPECT_GT(made, 0);
  EXPECT_LT(made, 8);
}

TEST(Worker, AFailureThatWouldEndTheSameIsNotTriedAgain) {
  const Plan plan = MakePlan(WriteCampaign(kSoils), OwnFolder() / "out");
  MakeFolder(plan.folder / "failed");
  WriteFailure({FailureReason::kBadInput, "a key"}, plan.FailureFile(0));
  WriteFailure({FailureReason::kKilled, "signal 9"}, plan.FailureFile(1));
  EXPECT_THAT([&] { RunEpisode(plan, 0, {}); },
              ThrowsFault(FaultKind::kInconsistent, "failed/000000.yaml"));
  EXPECT_FALSE(fs::exists(plan.EpisodeFolder(0)));
  RunEpisode(plan, 1, {});
  EXPECT_FALSE(fs::exists(plan.FailureFile(1)));
}

TEST(Worker, AResumedEpisodeCostsWhatAllItsTriesCost) {
  using std::chrono::seconds;
  const Plan plan = MakePlan(WriteCampaign(kSoils), OwnFolder() / "out");
  const fs::path cost = plan.WorkFolder(0) / "cost", frame = plan.WorkFolder(0) / "frame";
  MakeFolder(plan.WorkFolder(0));
  WriteWholeFile(cost, "100 54321\n");
  WriteWholeFile(frame, "");  // the last file of a try that began 30 s before it, and was killed
  fs::last_write_time(cost, fs::last_write_time(frame) - seconds(30));
  RunEpisode(plan, 0, {});
  const EpisodeRecord record = ReadRecord(plan.EpisodeFolder(0) / "episode.yaml");
  EXPECT_GT(record.wall_s, 130);
  EXPECT_LT(record.wall_s, 160);
  EXPECT_EQ(record.peak_mb, 54321);
}

TEST(Worker, ANumberBeyondTheCampaignIsRefused) {
  const Plan plan = MakePlan(WriteCampaign(kSoils), OwnFolder() / "out");
  EXPECT_THAT([&] { RunEpisode(plan, 4, {}); }, ThrowsFault(FaultKind::kOutOfRange, "--index"));
}

TEST(Failure, TooLittleMemoryIsNoBug) {
  EXPECT_EQ(ReasonOf(std::bad_alloc()), FailureReason::kMemory);
  EXPECT_EQ(ReasonOf(InputError("a", {FaultKind::kMissing, "b"})), FailureReason::kBadInput);
  EXPECT_EQ(ReasonOf(std::logic_error("c")), FailureReason::kBug);
  EXPECT_TRUE(IsWorthRetry(FailureReason::kMemory));
}

TEST(Judge, FiguresAreThoseOfTheTables) {
  const Plan plan = MakePlan(WriteCampaign(kSoils), OwnFolder() / "out");
  RunEpisode(plan, 0, {});
  const fs::path dataset = plan.EpisodeFolder(0) / "data";
  WriteWholeFile(dataset / "made.csv", "t_ns,x\n0,1\n1,-4\n2,6\n3,5\n");
  const auto figure = [&](ColumnFigure of) {
    return FigureOf({.name = "x", .figure = TableColumn{"made.csv", "x", of}}, dataset);
  };
  EXPECT_EQ(figure(ColumnFigure::kLargest), 6);
  EXPECT_EQ(figure(ColumnFigure::kLeast), -4);
  EXPECT_EQ(figure(ColumnFigure::kMean), 2);
  EXPECT_EQ(figure(ColumnFigure::kLast), 5);
  EXPECT_THAT(
      [&] {
        FigureOf({.name = "y", .figure = TableColumn{"made.csv", "y"}}, dataset);
      },
      ThrowsFault(FaultKind::kMissing, "made.csv"));
}

}  // namespace
}  // namespace tera
