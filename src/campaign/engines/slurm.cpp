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
#include <limits>
#include <map>
#include <set>
#include <string_view>
#include <thread>

#include "core/error.h"
#include "core/parse_number.h"
#include "dataset/files/checked_file.h"
#include "dataset/files/child_process.h"
#include "dataset/files/folder_lock.h"

namespace tera {
namespace fs = std::filesystem;
namespace {

constexpr double kShortestTask_s = 300;   ///< shorter tasks burden the controller
constexpr int kSilences = 40;             ///< number of queries in a row that may stay unanswered
constexpr double kFirstMemory_mb = 4000;  ///< used if a task ran out of memory and its limit is
                                          ///< unknown
constexpr int kObstacles = 2;  ///< failed tasks that exclude a node; a single one may be due to the
                               ///< episode or a shared disk
constexpr std::size_t kMostEpisodesAtOnce = 100'000;
constexpr std::size_t kShareOfJobs = 2;  ///< only 1/kShareOfJobs of the job limit is used, because
                                         ///< the controller keeps jobs of other users too
constexpr std::size_t kLastOfLog_bytes = 1000;  ///< shown if no episode succeeds any more

struct Answer {
  int status = 0;
  std::string text;  ///< standard output and error
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

/// Value of KEY=VALUE in a line of `scontrol --oneliner`; empty if absent.
std::string WordOf(const std::string& line, const std::string& key) {
  const std::size_t at = (" " + line).find(" " + key + "=");
  if (at == std::string::npos) return "";
  const std::size_t begin = at + key.size() + 1;
  return line.substr(begin, line.find_first_of(" \n", begin) - begin);
}

/// Parses a size such as "4000M", "3.50G" or "4000" to MB. As in Slurm, 1 G is 1024 M. An empty
/// text is 0.
double MbOf(const std::string& text) {
  constexpr std::string_view kUnits = "KMGT";
  const std::size_t unit = text.empty() ? kUnits.npos : kUnits.find(text.back());
  const auto number = ParseFinite(unit == kUnits.npos ? text : text.substr(0, text.size() - 1));
  if (!number) return 0;
  return unit == kUnits.npos ? *number : *number * std::pow(1024.0, static_cast<double>(unit) - 1);
}

/// A job, or a task of an array, from `scontrol --oneliner show job`.
struct Task {
  std::string id, state, node, log, array, place;  ///< place is the task's index in its array
  double memory_mb = 0;                            ///< 0 if unlimited
};

Task TaskIn(const std::string& line) {
  return {.id = WordOf(line, "JobId"),
          .state = WordOf(line, "JobState"),
          .node = WordOf(line, "NodeList"),
          .log = WordOf(line, "StdOut"),
          .array = WordOf(line, "ArrayJobId"),
          .place = WordOf(line, "ArrayTaskId"),
          .memory_mb = std::max(
              MbOf(WordOf(line, "MinMemoryNode")),
              MbOf(WordOf(line, "MinMemoryCPU")) * std::max(1.0, MbOf(WordOf(line, "NumCPUs"))))};
}

/// Largest memory that a task can have on one node; infinite if Slurm does not report it.
double AskLargestNode_mb() {
  double most_mb = 0;
  for (const std::string& line : LinesOf(Ask("scontrol --oneliner show nodes").text)) {
    const double here_mb = MbOf(WordOf(line, "RealMemory")) - MbOf(WordOf(line, "MemSpecLimit"));
    most_mb = std::max(most_mb, here_mb);
  }
  // Slurm reports 1 if memory is not configured
  return most_mb > 1 ? most_mb : std::numeric_limits<double>::infinity();
}

struct Limits {
  std::size_t of_array = 1000, of_jobs = 10'000;  ///< limits on tasks; these are Slurm's defaults
};

Limits AskLimits() {
  const Answer answer = Ask("scontrol show config");
  if (answer.status != 0) {
    FailSlurm("Slurm does not answer `scontrol show config`: " + answer.text +
              "; run on a host with its commands and controller, or without --on");
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
    std::signal(SIGCHLD, SIG_DFL);  // if the parent ignored SIGCHLD, statuses of children would be
                                    // lost
    if (fs::exists(JobsFile())) {
      const Jobs jobs = LinesOf(ReadWholeFile(JobsFile()));
      Say(fmt::format("waits for jobs {} of an interrupted run", fmt::join(jobs, ", ")));
      Wait(jobs);
      AskForMore();
    }
    CampaignState state = Collect();
    left_to_retry_ = LackingIn(state);
    for (int without = 0; !state.missing.empty();) {
      if (without == options_.tries) GiveUp();
      const std::size_t before = state.missing.size();
      Wait(Submit(state));
      AskForMore();
      state = Collect();
      without = state.missing.size() < before ? 0 : without + 1;
    }
    return state;
  }

 private:
  using Jobs = std::vector<std::string>;
  struct Array {
    std::vector<int> episodes;
    std::size_t each = 1;  ///< episodes per task
  };

  fs::path JobsFile() const { return plan_.folder / "slurm.jobs"; }

  /// Current state. Killed episodes count as missing instead of failed.
  CampaignState Collect() const {
    const CampaignState state = RefreshIndex(plan_);
    bool is_any = false;
    for (const auto& [number, failure] : state.failed) {
      if (failure.reason != FailureReason::kKilled) continue;
      is_any = fs::remove(plan_.FailureFile(number)) || is_any;
    }
    return is_any ? RefreshIndex(plan_) : state;
  }

  /// Episodes that failed for lack of memory in the last arrays.
  std::set<int> LackingIn(const CampaignState& state) const {
    std::set<int> lacking;
    for (const auto& [number, failure] : state.failed) {
      const bool is_new = !left_to_retry_.contains(number);
      if (failure.reason == FailureReason::kMemory && is_new) lacking.insert(number);
    }
    return lacking;
  }

  /// After arrays in which memory was short: doubles the memory of the next arrays, up to that of
  /// the largest node. If they already had that much, the affected episodes fail.
  void AskForMore() {
    const CampaignState state = RefreshIndex(plan_);
    const std::set<int> told = LackingIn(state);
    if (told.empty() && !lacked_memory_) return;
    const double had_mb = std::max<double>(memory_mb_, task_mb_), most_mb = AskLargestNode_mb();
    const double larger_mb = 2 * std::max(had_mb, state.LargestPeakMb()),
                 wanted_mb = had_mb > 0 ? larger_mb : std::max(larger_mb, kFirstMemory_mb);
    memory_mb_ = static_cast<int>(std::min(wanted_mb, most_mb));
    if (had_mb < most_mb) {
      for (const int number : told) fs::remove(plan_.FailureFile(number));
    } else {
      left_to_retry_.insert(told.begin(), told.end());
      for (const auto& episodes : lacking_) FailFirstBegun(episodes, state, most_mb);
    }
    task_mb_ = 0;
    lacked_memory_ = false;
    lacking_.clear();
  }

  /// Marks the first begun episode of a task as failed, because the task ran it when memory was
  /// exhausted.
  void FailFirstBegun(const std::vector<int>& episodes, const CampaignState& state,
                      double most_mb) {
    const auto begun =
        std::ranges::find_if(episodes, [&](int number) { return state.begun.contains(number); });
    if (begun == episodes.end()) return;
    WriteFailure({FailureReason::kMemory,
                  fmt::format("{:.0f} MB were too little, and no node has more", most_mb)},
                 plan_.FailureFile(*begun));
    left_to_retry_.insert(*begun);
  }

  std::size_t EpisodesOfTask(const CampaignState& state) const {
    if (options_.per_task > 0) return static_cast<std::size_t>(options_.per_task);
    const double each_s = state.MeanWall_s();
    return each_s > 0 ? static_cast<std::size_t>(std::ceil(kShortestTask_s / each_s)) : 1;
  }

  /// Script of an array. Each case lists the episodes of one task.
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

  /// Submits arrays for the missing episodes. If a job limit refuses the first array, it is
  /// submitted with half as many tasks. If the limit refuses a later array, the remaining episodes
  /// wait for the next call.
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
      arrays_[jobs.back()] = {numbers, each};
      WriteWholeFile(JobsFile(), fmt::format("{}\n", fmt::join(jobs, "\n")));
      Say(fmt::format("job {}: {} episodes in {} tasks", jobs.back(), count, tasks));
    }
    return jobs;
  }

  /// Waits until no task of the jobs is pending or running. Evaluates tasks that did not end
  /// normally.
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
        fmt::format("the controller does not answer; jobs {} continue without it, and the same "
                    "command later makes the missing episodes",
                    fmt::join(jobs, ", ")));
  }

  /// True if any task is pending or running, that is, in a state other than kLast.
  bool Look(const std::string& tasks) {
    static const std::set<std::string> kLast = {
        "BOOT_FAIL", "CANCELLED",     "COMPLETED", "DEADLINE", "FAILED",
        "NODE_FAIL", "OUT_OF_MEMORY", "PREEMPTED", "REVOKED",  "TIMEOUT"};
    bool is_under_way = false;
    std::map<std::string, int> ended;
    for (const std::string& line : LinesOf(tasks)) {
      const Task task = TaskIn(line);
      task_mb_ = std::max(task_mb_, task.memory_mb);
      const bool has_ended = task.state.empty() || kLast.contains(task.state);
      is_under_way = is_under_way || !has_ended;
      const bool is_well = task.state.empty() || task.state == "COMPLETED";
      if (is_well || !has_ended || !seen_.insert(task.id).second) continue;
      ++ended[fmt::format("{} on {}", task.state, task.node)];
      Learn(task);
    }
    for (const auto& [how, count] : ended) Say(fmt::format("{} tasks ended by {}", count, how));
    return is_under_way;
  }

  void Learn(const Task& task) {
    if (task.state == "OUT_OF_MEMORY") {
      lacked_memory_ = true;
      lacking_.push_back(EpisodesOf(task));
    }
    if (task.state == "FAILED") obstacle_log_ = task.log;
    const bool is_lost = task.state == "NODE_FAIL" || task.state == "BOOT_FAIL";
    if (task.node.empty() || task.node == "(null)") return;
    if (is_lost || (task.state == "FAILED" && ++obstacles_[task.node] == kObstacles)) {
      excluded_.insert(task.node);
    }
  }

  /// Episodes of a task; empty if an earlier, interrupted run submitted the array.
  std::vector<int> EpisodesOf(const Task& task) const {
    const auto array = arrays_.find(task.array);
    const auto place = ParseNumber<std::size_t>(task.place);
    if (array == arrays_.end() || !place) return {};
    const auto& [numbers, each] = array->second;
    const std::size_t begin = std::min(*place * each, numbers.size());
    return {numbers.begin() + static_cast<std::ptrdiff_t>(begin),
            numbers.begin() + static_cast<std::ptrdiff_t>(std::min(begin + each, numbers.size()))};
  }

  /// End of the log of the last task that failed.
  std::string LastObstacle() const {
    if (obstacle_log_.empty() || !fs::exists(obstacle_log_)) return "";
    const std::string text = ReadWholeFile(obstacle_log_);
    std::vector<std::string> nodes;
    for (const auto& [node, _] : obstacles_) nodes.push_back(node);
    return fmt::format("; nodes {} met obstacles; {} ends:\n{}", fmt::join(nodes, ", "),
                       obstacle_log_,
                       text.substr(text.size() - std::min(text.size(), kLastOfLog_bytes)));
  }

  [[noreturn]] void GiveUp() const {
    FailSlurm(fmt::format(
        "arrays ended without an episode {} times in a row; check logs/, and run again{}",
        options_.tries, LastObstacle()));
  }

  void Say(const std::string& text) const {
    if (options_.say) options_.say(text);
  }

  const Plan& plan_;
  const SlurmOptions& options_;
  int memory_mb_;       ///< requested memory
  double task_mb_ = 0;  ///< largest memory limit of a task in the last arrays, including defaults
  bool lacked_memory_ = false;
  std::vector<std::vector<int>> lacking_;  ///< per task that ran out of memory, its episodes
  std::set<int> left_to_retry_;  ///< episodes that failed for lack of memory and are not retried
  std::map<std::string, Array> arrays_;
  std::map<std::string, int> obstacles_;  ///< number of failed tasks by node
  std::set<std::string> excluded_;        ///< excluded nodes
  std::set<std::string> seen_;            ///< tasks already evaluated
  std::string obstacle_log_;
};

}  // namespace

CampaignState RunOnSlurm(const Plan& plan, const SlurmOptions& options) {
  return SlurmRun(plan, options).Run();
}

}  // namespace tera
