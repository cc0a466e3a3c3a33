#include "campaign/work/index.h"

#include <gtest/gtest.h>

#include "campaign/campaign_files.h"
#include "campaign/work/worker.h"
#include "core/faults.h"

namespace tera {
namespace {

namespace fs = std::filesystem;

TEST(Index, IsMadeAnewOfWhatIsThere) {
  const Plan plan = MakePlan(WriteCampaign(kSoils), OwnFolder() / "out");
  RunEpisode(plan, 2, {});
  WriteFailure({FailureReason::kKilled, "signal 9"}, plan.FailureFile(1));
  MakeFolder(plan.WorkFolder(3) / "draw_0/data.incomplete");  // stopped half-way
  for (int time = 0; time < 2; ++time) {
    const CampaignState state = RefreshIndex(plan);
    EXPECT_EQ(state.done.size(), 1u);
    EXPECT_TRUE(state.done.contains(2));
    EXPECT_EQ(state.failed.at(1).reason, FailureReason::kKilled);
    EXPECT_EQ(state.begun, std::set<int>{3});
    EXPECT_EQ(state.missing, (std::vector<int>{0, 3}));
    EXPECT_GT(state.LargestPeakMb(), 1);
    fs::remove(plan.folder / "index.sqlite");
  }
  EXPECT_EQ(ClearFailures(plan, false), 1);
  EXPECT_EQ(RefreshIndex(plan).missing, (std::vector<int>{0, 1, 3}));
}

TEST(Index, BadInputIsTriedAgainOnlyWhenAllAreAskedFor) {
  const Plan plan = MakePlan(WriteCampaign(kSoils), OwnFolder() / "out");
  WriteFailure({FailureReason::kBadInput, "a \"quoted\" key\nand a line"}, plan.FailureFile(0));
  EXPECT_EQ(ClearFailures(plan, false), 0);
  EXPECT_EQ(RefreshIndex(plan).failed.at(0).message, "a \"quoted\" key\nand a line");
  EXPECT_EQ(ClearFailures(plan, true), 1);
}

TEST(Index, ThatOfAnotherCampaignIsRefused) {
  const Plan one = MakePlan(WriteCampaign(kSoils), OwnFolder() / "one");
  RefreshIndex(one);
  const Plan other =
      MakePlan(WriteCampaign(std::string(kSoils) + "seed: 2\n"), OwnFolder() / "other");
  fs::copy_file(one.folder / "index.sqlite", other.folder / "index.sqlite");
  EXPECT_THAT([&] { RefreshIndex(other); },
              ThrowsFault(FaultKind::kInconsistent, "other/index.sqlite"));
  WriteWholeFile(other.folder / "index.sqlite", "this is no index, but a text that is long");
  EXPECT_THAT([&] { RefreshIndex(other); }, ThrowsFault(FaultKind::kMalformed, "index.sqlite"));
}

TEST(Index, AnEpisodeOfAnotherCampaignIsRefused) {
  const Plan one = MakePlan(WriteCampaign(kSoils), OwnFolder() / "one");
  RunEpisode(one, 0, {});
  const Plan other =
      MakePlan(WriteCampaign(std::string(kSoils) + "seed: 2\n"), OwnFolder() / "other");
  fs::rename(one.EpisodeFolder(0), other.EpisodeFolder(0));
  EXPECT_THAT([&] { RefreshIndex(other); },
              ThrowsFault(FaultKind::kInconsistent, "000000/episode.yaml"));
}

}  // namespace
}  // namespace tera
