#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <map>
#include <thread>

#include "app/program.h"
#include "app/refused.h"
#include "campaign/campaign_files.h"
#include "core/faults.h"
#include "dataset/files/file_digest.h"
#include "dataset/files/folder_lock.h"
#include "dataset/files/tiny_disk.h"

// `tera campaign` from a user's view.

namespace tera {
namespace {

using testing::AllOf;
using testing::HasSubstr;
namespace fs = std::filesystem;

/// Six short episodes: two soils, three draws of the sun each.
constexpr char kSix[] = R"(name: six
scenario: resting.yaml
episodes: 6
factors:
  - {key: terrain.soil, levels: [dirt, sand]}
)";

class CampaignCommand : public testing::Test {
 protected:
  CampaignCommand() {
    WriteWholeFile(scratch_.path() / "resting.yaml", kRestingRover);
    WriteWholeFile(scratch_.path() / "six.yaml", kSix);
  }

  Outcome Tera(const Arguments& arguments) { return RunTera(arguments, {scratch_.path()}); }
  void Plan(const std::string& folder) {
    EXPECT_EQ(Tera({"campaign", "plan", "six.yaml", "--out", folder}).status, 0);
  }
  /// Digests of all files of the datasets, by name.
  std::map<std::string, std::string> Bytes(const std::string& folder) const {
    std::map<std::string, std::string> digests;
    const fs::path episodes = scratch_.path() / folder / "episodes";
    for (const auto& entry : fs::recursive_directory_iterator(episodes)) {
      if (!entry.is_regular_file() || entry.path().filename() == "episode.yaml") continue;
      digests[entry.path().lexically_relative(episodes)] = DigestOf(entry.path()).sha256;
    }
    return digests;
  }

  ScratchDirectory scratch_;
};

TEST_F(CampaignCommand, ThePoolMakesWhatSingleWorkersMake) {
  Plan("pool");
  const Outcome pool = Tera({"campaign", "run", "pool", "--processes", "2"});
  EXPECT_EQ(pool.status, 0) << pool.err;
  EXPECT_THAT(pool.out, HasSubstr("6 of 6 episodes done, 0 failed"));
  EXPECT_THAT(pool.err, HasSubstr("left"));
  Plan("alone");
  for (const char* index : {"5", "0", "3", "1", "4", "2", "2"}) {
    EXPECT_EQ(Tera({"campaign", "run", "alone", "--index", index, "--threads", "2"}).status, 0);
  }
  EXPECT_EQ(Bytes("pool"), Bytes("alone"));
  EXPECT_EQ(Tera({"campaign", "status", "alone"}).status, 0);
}

TEST_F(CampaignCommand, GoesOnWhereItWasKilled) {
  WriteWholeFile(scratch_.path() / "resting.yaml",
                 Edited(kRestingRover, "duration_s: 0.2", "duration_s: 2"));
  Plan("whole");
  EXPECT_EQ(Tera({"campaign", "run", "whole"}).status, 0);
  Plan("killed");
  TeraProcess run({"campaign", "run", "killed", "--processes", "2"}, {scratch_.path()});
  const fs::path first = scratch_.path() / "killed/episodes/000000";
  while (run.Running() && !fs::exists(first)) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  run.Signal(SIGKILL);
  EXPECT_EQ(run.Wait().signal, SIGKILL);
  const Outcome status = Tera({"campaign", "status", "killed"});
  EXPECT_EQ(status.status, 1) << "not all is done: " << status.out;
  const Outcome again = Tera({"campaign", "run", "killed"});
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(Bytes("killed"), Bytes("whole"));
  EXPECT_TRUE(fs::is_empty(scratch_.path() / "killed/work"));
}

TEST_F(CampaignCommand, AnEpisodeThatAnotherWorkerMakesIsLeftToIt) {
  Plan("six");
  const fs::path work = scratch_.path() / "six/work/000002";
  fs::create_directories(work);
  const FolderLock other(work);
  const Outcome pool = Tera({"campaign", "run", "six"});
  EXPECT_EQ(pool.status, 1) << pool.err;
  EXPECT_THAT(pool.out, HasSubstr("5 of 6 episodes done, 0 failed, 1 to do, of them 1 begun"));
}

TEST_F(CampaignCommand, AFullDiskStopsThePoolAndLosesNothing) {
  TinyDisk disk(scratch_.path() / "disk", "400k");
  ASSERT_TRUE(disk.mounted()) << "needs root, or the right to make user namespaces";
  Plan("disk/six");
  const Outcome full = Tera({"campaign", "run", "disk/six", "--processes", "1"});
  EXPECT_EQ(full.status, 2) << full.out;
  EXPECT_THAT(full.err, AllOf(HasSubstr("a full disk"), HasSubstr("run again")));
  EXPECT_TRUE(fs::is_empty(scratch_.path() / "disk/six/failed"));
  ASSERT_TRUE(disk.Grow("64m"));
  const Outcome again = Tera({"campaign", "run", "disk/six"});
  EXPECT_EQ(again.status, 0) << again.err;
}

TEST_F(CampaignCommand, ParallelMakesWhatThePoolMakes) {
  if (std::system("command -v parallel >/dev/null") != 0) GTEST_SKIP() << "needs GNU parallel";
  WriteWholeFile(scratch_.path() / "hosts", "2/:\n");  // this computer, two at once
  Plan("pool");
  EXPECT_EQ(Tera({"campaign", "run", "pool"}).status, 0);
  Plan("over ssh");  // parallel has a shell read its words again
  const Outcome run = Tera({"campaign", "run", "over ssh", "--on", "ssh", "--hosts", "hosts"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(Bytes("over ssh"), Bytes("pool"));
}

TEST_F(CampaignCommand, AnEngineThatLacksWhatItNeedsIsRefused) {
  Plan("six");
  ExpectRefused(scratch_, {"campaign", "run", "six", "--on", "ssh"}, HasSubstr("--hosts"));
  ExpectRefused(scratch_, {"campaign", "run", "six", "--on", "kubernetes"}, HasSubstr("--volume"));
  const Outcome job = Tera({"campaign", "run", "six", "--on", "kubernetes", "--image", "tera:1",
                            "--volume", "sites:" + scratch_.path().string()});
  EXPECT_EQ(job.status, 0) << job.err;
  EXPECT_TRUE(fs::exists(scratch_.path() / "six/kubernetes.yaml"));
}

TEST_F(CampaignCommand, AnOptionOfAnotherEngineIsRefused) {
  Plan("six");
  const auto expect_refused = [&](Arguments arguments, const std::string& option) {
    arguments.insert(arguments.begin(), {"campaign", "run", "six"});
    ExpectRefused(scratch_, arguments, TellsOf(option));
  };
  expect_refused({"--memory-mb", "2000"}, "--memory-mb");
  expect_refused({"--index", "0", "--processes", "2"}, "--processes");
  expect_refused({"--index", "0", "--on", "slurm"}, "--on");
  expect_refused({"--on", "slurm", "--processes", "2"}, "--processes");
  expect_refused({"--on", "kubernetes", "--minutes", "5"}, "--minutes");
  expect_refused({"--on", "ssh", "--hosts", "six.yaml", "--image", "a"}, "--image");
}

TEST_F(CampaignCommand, AFolderThatIsNoCampaignIsRefused) {
  ExpectRefused(scratch_, {"campaign", "run", "nowhere"},
                AllOf(HasSubstr("nowhere/plan.yaml: "), HasSubstr("tera campaign plan")));
}

}  // namespace
}  // namespace tera
