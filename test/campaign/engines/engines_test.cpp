#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "campaign/campaign_files.h"
#include "campaign/engines/emitters.h"
#include "campaign/engines/pool.h"
#include "campaign/engines/slurm.h"
#include "core/config/config.h"
#include "core/faults.h"
#include "dataset/files/folder_lock.h"

namespace tera {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

constexpr char kTwelve[] = R"(name: twelve
scenario: resting.yaml
episodes: 12
factors: [{key: terrain.soil, levels: [dirt, sand]}]
)";

/// A worker that takes no time: episode 5 is bad input, 7 crashes, the others come out, 9 when it
/// is tried again after a hang-up.
constexpr char kWorker[] = R"sh(#!/bin/sh
folder=$3; number=$5; name=$(printf %06d $number)
mkdir -p $folder/work/$name
[ $number -eq 9 ] && [ ! -e $folder/hung_up ] && touch $folder/hung_up && kill -HUP $$
[ $number -eq 5 ] && printf 'reason: bad_input\nmessage: a key\n' > $folder/failed/$name.yaml && exit 2
[ $number -eq 7 ] && kill -SEGV $$
mkdir -p $folder/episodes/$name
sed -n 's/^fingerprint/&/p' $folder/plan.yaml > $folder/episodes/$name/episode.yaml
cat >> $folder/episodes/$name/episode.yaml <<END
number: $number
draw: 0
seed: 1
values: {}
refused: []
sha256: "x"
bytes: 1
frames: 0
simulated_s: 1
wall_s: 100
peak_mb: 10
host: here
END
rm -r $folder/work/$name
)sh";

/// Notes its arguments and makes each task of the array at once, but for those that the file
/// `outcomes` lists: ARRAY TASK STATE NODE. Of such a task the first episode is begun. Arrays of
/// more than five tasks are refused.
constexpr char kSbatch[] = R"sh(#!/bin/sh
cd "$(dirname "$0")"
for script; do :; done
tasks=$(echo "$*" | sed 's/.*--array=0-\([0-9]*\).*/\1/')
if [ $tasks -ge 5 ]; then
  echo 'Job violates accounting/QOS policy (job submit limit)'
  exit 1
fi
echo "$*" >> calls
job=$(wc -l < calls)
: > state
for task in $(seq 0 $tasks); do
  outcome=$(sed -n "s/^$job $task //p" outcomes)
  if [ -n "$outcome" ]; then
    mkdir -p out/work/$(printf %06d $(sed -n "s/^$task) set -- \([0-9]*\).*/\1/p" "$script"))
  else
    outcome='COMPLETED one'
    SLURM_ARRAY_TASK_ID=$task sh "$script" > log 2>&1 || outcome='FAILED one'
  fi
  echo "JobId=$job$task ArrayJobId=$job ArrayTaskId=$task JobState=${outcome% *}" \
    "NodeList=${outcome#* } NumCPUs=2 $(cat memory) StdOut=$PWD/log" >> state
done
echo $job
)sh";

constexpr char kScontrol[] = R"sh(#!/bin/sh
here=$(dirname "$0")
case "$2$3" in
  config) echo "MaxArraySize            = $(cat "$here/most")";;
  shownodes) cat "$here/nodes";;
  *) cat "$here/state"; echo asked >> "$here/asked"
     [ ! -e "$here/later" ] || mv "$here/later" "$here/state";;
esac
)sh";

class SlurmTest : public testing::Test {
 protected:
  SlurmTest() : path_(std::getenv("PATH")) {
    Program("sbatch", kSbatch);
    Program("scontrol", kScontrol);
    Program("tera", kWorker);
    Outcomes("");
    WriteWholeFile(OwnFolder() / "most", "1001\n");
    WriteWholeFile(OwnFolder() / "nodes", "NodeName=one RealMemory=1 AllocMem=0\n");
    WriteWholeFile(OwnFolder() / "memory", "");
    setenv("PATH", (OwnFolder().string() + ":" + path_).c_str(), 1);
  }
  ~SlurmTest() override { setenv("PATH", path_.c_str(), 1); }

  static void Program(const std::string& name, const std::string& text) {
    WriteWholeFile(OwnFolder() / name, text);
    fs::permissions(OwnFolder() / name, fs::perms::owner_all);
  }
  static void Outcomes(const std::string& lines) {
    WriteWholeFile(OwnFolder() / "outcomes", lines);
  }
  CampaignState Run() {
    return RunOnSlurm(plan_, {.worker = {OwnFolder() / "tera", {}}, .poll_s = 0.001});
  }
  /// Arguments of each sbatch.
  static std::vector<std::string> Calls() {
    std::vector<std::string> calls;
    std::istringstream text(ReadWholeFile(OwnFolder() / "calls"));
    for (std::string line; std::getline(text, line);) calls.push_back(line);
    return calls;
  }

  std::string path_;
  Plan plan_ = MakePlan(WriteCampaign(kTwelve), OwnFolder() / "out");
};

TEST_F(SlurmTest, BadInputAndCrashesAreNotTriedAgain) {
  const CampaignState state = Run();
  EXPECT_EQ(state.done.size(), 10u);
  EXPECT_EQ(state.failed.at(5).reason, FailureReason::kBadInput);
  EXPECT_EQ(state.failed.at(7).reason, FailureReason::kBug);
  ASSERT_EQ(Calls().size(), 2u) << "the second has the episode that was hung up";
  EXPECT_THAT(Calls()[0], HasSubstr("--array=0-2 ")) << "12 tasks, then 6 are over the limit";
  EXPECT_THAT(Calls()[1], AllOf(HasSubstr("--array=0-0 "), Not(HasSubstr("--exclude"))))
      << "one obstacle may lie in the episode";
}

TEST_F(SlurmTest, ManyTasksAreSeveralArrays) {
  WriteWholeFile(OwnFolder() / "most", "4\n");
  WriteWholeFile(plan_.folder / "hung_up", "");
  EXPECT_EQ(Run().done.size(), 10u);
  ASSERT_EQ(Calls().size(), 4u);
  for (const std::string& call : Calls()) EXPECT_THAT(call, HasSubstr("--array=0-2 "));
}

TEST_F(SlurmTest, EachReasonHasItsRemedy) {
  WriteWholeFile(plan_.folder / "hung_up", "");
  Outcomes("1 0 NODE_FAIL two\n1 1 TIMEOUT one\n2 0 OUT_OF_MEMORY one\n3 0 OUT_OF_MEMORY one\n");
  EXPECT_EQ(Run().done.size(), 10u);
  const auto calls = Calls();
  ASSERT_EQ(calls.size(), 4u);
  EXPECT_THAT(calls[1],
              AllOf(HasSubstr("--exclude=two"), Not(HasSubstr("--mem")), Not(HasSubstr("--time"))));
  EXPECT_THAT(calls[2], HasSubstr("--mem=4000M"));
  EXPECT_THAT(calls[3], HasSubstr("--mem=8000M"));
}

TEST_F(SlurmTest, MemoryThatRanOutIsDoubledFromTheClustersDefault) {
  WriteWholeFile(OwnFolder() / "memory", "MinMemoryCPU=4G");  // of two processors
  Outcomes("1 0 OUT_OF_MEMORY one\n");
  EXPECT_EQ(Run().done.size(), 10u);
  EXPECT_THAT(Calls()[1], HasSubstr("--mem=16384M"));
}

TEST_F(SlurmTest, AnEpisodeThatNoNodeHasTheMemoryForFailsAlone) {
  WriteWholeFile(OwnFolder() / "nodes",
                 "NodeName=one RealMemory=3000\nNodeName=two RealMemory=6500 MemSpecLimit=500\n");
  Outcomes("1 0 OUT_OF_MEMORY two\n2 0 OUT_OF_MEMORY two\n3 0 OUT_OF_MEMORY two\n");
  WriteWholeFile(plan_.folder / "hung_up", "");
  const CampaignState state =
      RunOnSlurm(plan_, {.worker = {OwnFolder() / "tera", {}}, .per_task = 12, .poll_s = 0.001});
  EXPECT_EQ(state.failed.at(0).reason, FailureReason::kMemory);
  EXPECT_EQ(state.done.size(), 9u);
  ASSERT_EQ(Calls().size(), 4u);
  EXPECT_THAT(Calls()[1], HasSubstr("--mem=4000M"));
  EXPECT_THAT(Calls()[2], HasSubstr("--mem=6000M"));
  EXPECT_THAT(Calls()[3], HasSubstr("--mem=6000M"));
  EXPECT_EQ(Run().failed.at(0).reason, FailureReason::kMemory) << "left to retry";
}

TEST_F(SlurmTest, ANodeIsExcludedAfterItsSecondObstacle) {
  WriteWholeFile(plan_.folder / "hung_up", "");
  Outcomes("1 0 FAILED two\n2 0 FAILED two\n");
  EXPECT_EQ(Run().done.size(), 10u);
  ASSERT_EQ(Calls().size(), 3u);
  EXPECT_THAT(Calls()[1], Not(HasSubstr("--exclude")));
  EXPECT_THAT(Calls()[2], HasSubstr("--exclude=two"));
}

TEST_F(SlurmTest, AStateThatIsNotALastOneIsWaitedFor) {
  Run();
  for (const char* state : {"STOPPED", "SIGNALING", "STAGE_OUT", "RESIZING", "REQUEUE_HOLD"}) {
    WriteWholeFile(plan_.folder / "slurm.jobs", "1\n");
    WriteWholeFile(OwnFolder() / "state", fmt::format("JobId=1 JobState={} NodeList=x\n", state));
    WriteWholeFile(OwnFolder() / "later", "JobId=1 JobState=COMPLETED NodeList=x\n");
    fs::remove(OwnFolder() / "asked");
    Run();
    EXPECT_EQ(ReadWholeFile(OwnFolder() / "asked"), "asked\nasked\n") << state;
  }
}

TEST_F(SlurmTest, AnArrayOfARunThatWasStoppedIsWaitedForFirst) {
  WriteWholeFile(plan_.folder / "slurm.jobs", "1\n");
  WriteWholeFile(OwnFolder() / "state", "JobId=1 JobState=NODE_FAIL NodeList=two\n");
  EXPECT_EQ(Run().done.size(), 10u);
  EXPECT_THAT(Calls()[0], HasSubstr("--exclude=two"));
  EXPECT_FALSE(fs::exists(plan_.folder / "slurm.jobs"));
}

TEST_F(SlurmTest, ItGivesUpWhereNothingComesOut) {
  Program("tera", "#!/bin/sh\necho 'another version'; exit 2\n");
  EXPECT_THAT([&] { Run(); }, ThrowsFault(FaultKind::kUnsupported, "--on slurm"));
  EXPECT_EQ(Calls().size(), 3u);
}

TEST_F(SlurmTest, ItsAbsenceIsTold) {
  setenv("PATH", "/nowhere", 1);
  EXPECT_THAT([&] { Run(); }, ThrowsFault(FaultKind::kUnsupported, "--on slurm"));
}

TEST(Pool, ASecondOneOfAFolderIsRefused) {
  const Plan plan = MakePlan(WriteCampaign(kSoils), OwnFolder() / "out");
  const FolderLock first(plan.folder);
  EXPECT_THAT(
      [&] {
        RunPool(plan, {.worker = {"/bin/false", {}}});
      },
      ThrowsFault(FaultKind::kUnwritable, "out"));
}

TEST(Pool, CrashesAreBugsAndOtherSignalsAreKills) {
  const Plan plan = MakePlan(WriteCampaign(kTwelve), OwnFolder() / "out");
  const fs::path worker = OwnFolder() / "tera";
  WriteWholeFile(worker, kWorker);
  fs::permissions(worker, fs::perms::owner_all);
  const CampaignState state = RunPool(plan, {.worker = {worker, {}}});
  EXPECT_EQ(state.done.size(), 9u);
  EXPECT_EQ(state.failed.at(7).reason, FailureReason::kBug);
  EXPECT_EQ(state.failed.at(9).reason, FailureReason::kKilled);
}

TEST(Kubernetes, AJobHasAnIndexForEachEpisode) {
  const Plan plan = MakePlan(WriteCampaign(kTwelve), OwnFolder() / "out");
  KubernetesOptions options{.worker = {"tera", {"--threads", "2"}},
                            .image = "tera:1",
                            .claim = "sites",
                            .mounted_at = OwnFolder().parent_path(),
                            .parallel = 50,
                            .memory_mb = 3000};
  const Config config = Config::FromText(KubernetesJob(plan, options), "job");
  const ConfigMap spec = config.root().Map("spec");
  EXPECT_EQ(config.root().Text("apiVersion"), "batch/v1");
  EXPECT_EQ(config.root().Text("kind"), "Job");
  EXPECT_THAT(config.root().Map("metadata").Text("name"),
              testing::MatchesRegex("tera-twelve-[0-9a-f]{8}"));
  EXPECT_EQ(spec.Text("completionMode"), "Indexed");
  EXPECT_EQ(spec.Integer("completions", Between(0, 100, "")), 12);
  EXPECT_EQ(spec.Integer("parallelism", Between(0, 100, "")), 12);
  const ConfigMap pod = spec.Map("template").Map("spec");
  EXPECT_EQ(pod.Text("restartPolicy"), "Never");
  const ConfigMap worker = pod.List("containers").at(0);
  EXPECT_EQ(worker.Text("image"), "tera:1");
  EXPECT_THAT(worker.Texts("args"),
              Contains(testing::EndsWith(WorkerScript(plan, options.worker))));
  EXPECT_EQ(worker.Map("resources").Map("limits").Text("memory"), "3000M");
  EXPECT_EQ(worker.List("volumeMounts").at(0).Text("mountPath"), OwnFolder().parent_path());
  options.mounted_at = "/nowhere";
  EXPECT_THAT([&] { KubernetesJob(plan, options); },
              ThrowsFault(FaultKind::kInconsistent, "--volume"));
}

}  // namespace
}  // namespace tera
