#include <filesystem>
#include <set>

#include "own_folder.h"
#include "serve/live_stage_fixture.h"

// Episodes as datasets.

namespace tera {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

TEST(LiveStages, RecordsEveryEpisodeAsADataset) {
  const fs::path folder = OwnFolder() / "episodes";
  const auto names = [&] {
    std::set<std::string> found;
    for (const auto& entry : fs::directory_iterator(folder)) {
      found.insert(entry.path().filename());
    }
    return found;
  };
  const StageOptions options{.record = folder};
  {
    const std::unique_ptr<Stage> stage = NewStage(options);
    stage->Reset(v1::Reset());
    stage->Step(StepOf(50));
    stage->Reset(v1::Reset());
    EXPECT_TRUE(fs::exists(folder / "episode_0001" / "digger" / "commands.csv"));
    stage->Step(StepOf(20));
  }
  EXPECT_EQ(names(), (std::set<std::string>{"episode_0001", "episode_0002"}));
  {
    const std::unique_ptr<Stage> next_session = NewStage(options);
    next_session->Reset(v1::Reset());
  }
  EXPECT_TRUE(names().contains("episode_0003"));
}

Server::MakeStage StagesThatRecordIn(const fs::path& folder) {
  return LiveStages(*Source(std::nullopt).scenario, Source, {.record = folder},
                    [](const std::string&) {});
}

TEST(LiveStages, AFolderThatCannotBeWrittenIsRefusedAtTheStart) {
  const fs::path file = OwnFolder() / "file";
  std::fclose(std::fopen(file.c_str(), "w"));
  EXPECT_THROW(StagesThatRecordIn(file), InputError);
  EXPECT_THROW(StagesThatRecordIn(file / "inside"), InputError);
  EXPECT_THROW(StagesThatRecordIn("/proc"), InputError);  // a folder that nobody can create, not
                                                          // even root
}

TEST(LiveStages, TryingItsFolderLeavesNothingThere) {
  const fs::path folder = OwnFolder() / "tried/anew";
  StagesThatRecordIn(folder);
  EXPECT_TRUE(fs::is_empty(folder));
}

TEST(LiveStages, AnEpisodeThatCannotBeRecordedIsRefused) {
  const fs::path folder = OwnFolder() / "gone";
  const std::unique_ptr<Stage> stage = NewStage({.record = folder});
  fs::remove(folder);
  std::fclose(std::fopen(folder.c_str(), "w"));
  EXPECT_THROW(stage->Reset(v1::Reset()), InputError);
}

TEST(LiveStages, AFaultOfTheRecordingEndsTheEpisodeAndSaysWhatIsKept) {
  const fs::path folder = OwnFolder() / "faulty";
  const std::unique_ptr<Stage> stage = NewStage({.record = folder});
  EXPECT_FALSE(stage->InEpisode());
  stage->Reset(v1::Reset());
  EXPECT_TRUE(stage->InEpisode());
  const fs::path kept = folder / "episode_0001.incomplete";
  fs::remove_all(kept / "digger/lidar/scans");
  try {
    stage->Step(StepOf(500));
    FAIL() << "scans have no place, but the step was done";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("the episode ends here"), HasSubstr(kept.string()),
                                    HasSubstr("tera replay"), Not(HasSubstr("--resume"))));
  }
  EXPECT_FALSE(stage->InEpisode());
  EXPECT_TRUE(fs::exists(kept / "INCOMPLETE.txt"));
  EXPECT_THROW(stage->Step(StepOf(1)), InputError);
  stage->Reset(v1::Reset());
  EXPECT_TRUE(stage->InEpisode());
}

}  // namespace
}  // namespace tera
