#include "campaign/engines/slurm.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <map>
#include <set>
#include <thread>

#include "core/error.h"
#include "core/parse_number.h"
#include "dataset/files/checked_file.h"
#include "dataset/files/child_process.h"
#include "dataset/files/folder_lock.h"

namespace tera {
namespace fs = std::filesystem;
namespace {

constexpr double kShortestTask_s = 300;  ///< shorter ones burden the controller
constexpr int kSilences = 40;            ///< answers that may be missing in a row
constexpr int kFirstMemory_mb = 4000;    ///< where the cluster's default was too little
constexpr std::size_t kMostEpisodesAtOnce = 100'000;
constexpr std::size_t kShareOfJobs = 2;         ///< the controller keeps jobs of others too
constexpr std::size_t kLastOfLog_bytes = 1000;  ///< shown where nothing more comes out

struct Answer {
  int status = 0;
  std::string text;  ///< of standard output and error
};

Answer Ask(const std::string& command) {
  Answer answer;
  std::FILE* const pipe = popen((command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) throw InputError("sh", {FaultKind::kUnsupported, "cannot be started"});
  std::array<char, 4096> block;
  for (std::size_t count = 0; (count = fread(block.data(), 1, block.size(), pipe)) > 0;) {
    answer.text.append(block.data(), count);
  }
  const int status = pclose(pipe);
  answer.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return answer;
}

[[noreturn]] void FailSlurm(const std::string& finding) {
  throw InputError("--on slurm", {FaultKind::kUnsupported, finding});
}

std::vector<std::string> LinesOf(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    lines.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return lines;
}

/// A job, or a task of an array, by `scontrol --oneliner show job`.
struct Task {
  std::string id, state, node, log;
};

Task TaskIn(const std::string& line) {
  const auto word = [&](const std::string& key) -> std::string {
    const std::size_t at = (" " + line).find(" " + key + "=");
    if (at == std::string::npos) return "";
    const std::size_t begin = at + key.size() + 1;
    return line.substr(begin, line.find_first_of(" \n", begin) - begin);
  };
  return {word("JobId"), word("JobState"), word("NodeList"), word("StdOut")};
}

struct Limits {
  std::size_t of_array = 1000, of_jobs = 10'000;  ///< tasks; Slurm's own defaults
};

Limits AskLimits() {
  const Answer answer = Ask("scontrol show config");
  if (answer.status != 0) {
    FailSlurm("Slurm does not answer `scontrol show config`: " + answer.text +
              "; run where its commands and controller are, or without --on");
  }
  Limits limits;
  for (const std::string& line : LinesOf(answer.text)) {
    const auto number = ParseNumber<std::size_t>(line.substr(line.rfind(' ') + 1));
    if (!number || *number < 2) continue;
    if (line.starts_with("MaxArraySize")) limits.of_array = *number - 1;
    if (line.starts_with("MaxJobCount")) limits.of_jobs = *number;
  }
  return limits;
}

class SlurmRun {
 public:
  SlurmRun(const Plan& plan, const SlurmOptions& options)
      : plan_(plan), options_(options), memory_mb_(options.memory_mb) {}

  CampaignState Run() {
    const FolderLock lock(plan_.folder);
    std::signal(SIGCHLD, SIG_DFL);  // a parent that ignores it would leave nothing to wait for
    if (fs::exists(JobsFile())) {
      const Jobs jobs = LinesOf(ReadWholeFile(JobsFile()));
      Say(fmt::format("waits for jobs {} of a run that was stopped", fmt::join(jobs, ", ")));
      Wait(jobs);
    }
    CampaignState state = Collect();
    for (int without = 0; !state.missing.empty();) {
      if (without == options_.tries) GiveUp();
      const std::size_t before = state.missing.size();
      Wait(Submit(state));
      state = Collect();
      without = state.missing.size() < before ? 0 : without + 1;
    }
    return state;
  }

 private:
  using Jobs = std::vector<std::string>;

  fs::path JobsFile() const { return plan_.folder / "slurm.jobs"; }

  /// The state, in which episodes that another try may mend are missing and not failed.
  CampaignState Collect() {
    CampaignState state = RefreshIndex(plan_);
    for (const auto& [_, failure] : state.failed) {
      lacked_memory_ = lacked_memory_ || failure.reason == FailureReason::kMemory;
    }
    if (ClearFailures(plan_, false) > 0) state = RefreshIndex(plan_);
    if (lacked_memory_) memory_mb_ = std::max(2 * memory_mb_, kFirstMemory_mb);
    lacked_memory_ = false;
    return state;
  }

  std::size_t EpisodesOfTask(const CampaignState& state) const {
    if (options_.per_task > 0) return static_cast<std::size_t>(options_.per_task);
    const double each_s = state.MeanWall_s();
    return each_s > 0 ? static_cast<std::size_t>(std::ceil(kShortestTask_s / each_s)) : 1;
  }

  /// Script of an array, each case of which is a task's episodes.
  std::string Script(const std::vector<int>& numbers, std::size_t each) const {
    std::string script = "#!/bin/sh\ncase $SLURM_ARRAY_TASK_ID in\n";
    for (std::size_t begin = 0; begin < numbers.size(); begin += each) {
      const auto first = numbers.begin() + static_cast<std::ptrdiff_t>(begin),
                 end = first + static_cast<std::ptrdiff_t>(std::min(each, numbers.size() - begin));
      script += fmt::format("{}) set -- {};;\n", begin / each, fmt::join(first, end, " "));
    }
    return script + "esac\n" + WorkerScript(plan_, options_.worker);
  }

  std::string Command(std::size_t tasks) const {
    std::string command = fmt::format(
        "sbatch --parsable --no-requeue --job-name={} --array=0-{} --output={} --open-mode=append",
        plan_.campaign.name, tasks - 1, ShellWord(plan_.folder / "logs/slurm_%A_%a.log"));
    if (memory_mb_ > 0) command += fmt::format(" --mem={}M", memory_mb_);
    if (options_.minutes > 0) command += fmt::format(" --time={}", options_.minutes);
    if (!excluded_.empty()) command += fmt::format(" --exclude={}", fmt::join(excluded_, ","));
    return fmt::format("{} {} {}", command, options_.arguments,
                       ShellWord(plan_.folder / "slurm.sh"));
  }

  /// Submits arrays. Where a limit on jobs refuses the first, it gets half as many tasks. Where the
  /// limit refuses a later one, the rest waits for the next time.
  Jobs Submit(const CampaignState& state) {
    const Limits limits = AskLimits();
    std::vector<int> left = state.missing;
    left.resize(std::min(left.size(), kMostEpisodesAtOnce));
    const std::size_t most = std::max<std::size_t>(1, limits.of_jobs / kShareOfJobs);
    std::size_t each = std::max(EpisodesOfTask(state), (left.size() + most - 1) / most);
    Jobs jobs;
    while (!left.empty()) {
      const std::size_t count = std::min(left.size(), each * limits.of_array),
                        tasks = (count + each - 1) / each;
      const std::vector<int> numbers(left.begin(),
                                     left.begin() + static_cast<std::ptrdiff_t>(count));
      WriteWholeFile(plan_.folder / "slurm.sh", Script(numbers, each));
      const Answer answer = Ask(Command(tasks));
      if (answer.status != 0) {
        const bool is_limit = answer.text.find("imit") != std::string::npos;
        if (is_limit && !jobs.empty()) break;
        if (!is_limit || tasks == 1) {
          FailSlurm(
              fmt::format("Slurm refuses the array: {}; change --sbatch, --memory-mb or "
                          "--minutes{}",
                          answer.text, LastObstacle()));
        }
        each *= 2;
        continue;
      }
      left.erase(left.begin(), left.begin() + static_cast<std::ptrdiff_t>(count));
      jobs.push_back(answer.text.substr(0, answer.text.find_first_of(";\n")));
      WriteWholeFile(JobsFile(), fmt::format("{}\n", fmt::join(jobs, "\n")));
      Say(fmt::format("job {}: {} episodes in {} tasks", jobs.back(), count, tasks));
    }
    return jobs;
  }

  /// Waits until no task of the jobs waits or runs, and learns from those that ended otherwise than
  /// they should.
  void Wait(const Jobs& jobs) {
    for (int silences = 0; silences < kSilences;) {
      std::this_thread::sleep_for(std::chrono::duration<double>(options_.poll_s));
      bool is_silent = false, is_under_way = false;
      for (const std::string& job : jobs) {
        const Answer answer = Ask("scontrol --oneliner show job " + ShellWord(job));
        is_silent = is_silent ||
                    (answer.status != 0 && answer.text.find("Invalid job id") == std::string::npos);
        is_under_way = Look(answer.text) || is_under_way;
      }
      silences = is_silent ? silences + 1 : 0;
      if (is_silent || is_under_way) continue;
      fs::remove(JobsFile());
      return;
    }
    FailSlurm(
        fmt::format("the controller does not answer; jobs {} go on without it, and the same "
                    "command later goes on with what is missing then",
                    fmt::join(jobs, ", ")));
  }

  /// Whether tasks are under way.
  bool Look(const std::string& tasks) {
    static const std::set<std::string> kUnderWay = {"PENDING",    "RUNNING",   "CONFIGURING",
                                                    "COMPLETING", "SUSPENDED", "REQUEUED"};
    bool is_under_way = false;
    std::map<std::string, int> ended;
    for (const std::string& line : LinesOf(tasks)) {
      const Task task = TaskIn(line);
      if (kUnderWay.contains(task.state)) is_under_way = true;
      const bool is_well = task.state.empty() || task.state == "COMPLETED";
      if (is_well || kUnderWay.contains(task.state) || !seen_.insert(task.id).second) continue;
      ++ended[fmt::format("{} on {}", task.state, task.node)];
      Learn(task);
    }
    for (const auto& [how, count] : ended) Say(fmt::format("{} tasks ended by {}", count, how));
    return is_under_way;
  }

  void Learn(const Task& task) {
    if (task.state == "OUT_OF_MEMORY") lacked_memory_ = true;
    const bool is_of_node =
        task.state == "NODE_FAIL" || task.state == "BOOT_FAIL" || task.state == "FAILED";
    if (is_of_node && !task.node.empty() && task.node != "(null)") excluded_.insert(task.node);
    if (task.state == "FAILED") obstacle_log_ = task.log;
  }

  /// The end of the log of a task that met an obstacle.
  std::string LastObstacle() const {
    if (obstacle_log_.empty() || !fs::exists(obstacle_log_)) return "";
    const std::string text = ReadWholeFile(obstacle_log_);
    return fmt::format("; nodes {} met obstacles; {} ends:\n{}", fmt::join(excluded_, ", "),
                       obstacle_log_,
                       text.substr(text.size() - std::min(text.size(), kLastOfLog_bytes)));
  }

  [[noreturn]] void GiveUp() const {
    FailSlurm(
        fmt::format("arrays ended without an episode {} times in a row; look into logs/, and run "
                    "again{}",
                    options_.tries, LastObstacle()));
  }

  void Say(const std::string& text) const {
    if (options_.say) options_.say(text);
  }

  const Plan& plan_;
  const SlurmOptions& options_;
  int memory_mb_;
  bool lacked_memory_ = false;
  std::set<std::string> excluded_;  ///< nodes
  std::set<std::string> seen_;      ///< tasks that were learnt from
  std::string obstacle_log_;
};

}  // namespace

CampaignState RunOnSlurm(const Plan& plan, const SlurmOptions& options) {
  return SlurmRun(plan, options).Run();
}

}  // namespace tera
