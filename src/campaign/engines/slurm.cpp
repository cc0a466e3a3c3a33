#include "campaign/engines/slurm.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <set>
#include <thread>

#include "core/error.h"
#include "core/parse_number.h"
#include "dataset/files/checked_file.h"
#include "dataset/files/child_process.h"

namespace tera {
namespace fs = std::filesystem;
namespace {

constexpr double kShortestTask_s = 300;  ///< shorter ones burden the controller
constexpr int kDefaultArraySize = 1001;  ///< Slurm's own
constexpr int kSilences = 40;            ///< answers of a controller that may be missing in a row

struct Answer {
  int status = 0;
  std::string text;  ///< of standard output and error
};

Answer Ask(const std::string& command) {
  Answer answer;
  std::FILE* const pipe = popen((command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) throw InputError("sh", {FaultKind::kUnsupported, "cannot be started"});
  char block[4096];
  for (std::size_t count = 0; (count = fread(block, 1, sizeof block, pipe)) > 0;) {
    answer.text.append(block, count);
  }
  const int status = pclose(pipe);
  answer.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return answer;
}

/// The word behind "KEY=" in a line of scontrol; empty without one.
std::string WordOf(const std::string& line, const std::string& key) {
  const std::size_t at = (" " + line).find(" " + key + "=");
  if (at == std::string::npos) return "";
  const std::size_t begin = at + key.size() + 1;
  return line.substr(begin, line.find_first_of(" \n", begin) - begin);
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

int MostTasks() {
  const Answer answer = Ask("scontrol show config");
  if (answer.status != 0) {
    throw InputError("--on slurm", {FaultKind::kUnsupported,
                                    "Slurm does not answer `scontrol show config`: " + answer.text +
                                        "; run where its commands and controller are, or without "
                                        "--on"});
  }
  for (const std::string& line : LinesOf(answer.text)) {
    if (!line.starts_with("MaxArraySize")) continue;
    const auto size = ParseNumber<int>(line.substr(line.rfind(' ') + 1));
    if (size && *size > 1) return *size - 1;
  }
  return kDefaultArraySize - 1;
}

/// What a further array does otherwise.
struct Demands {
  int memory_mb = 0, minutes = 0;
  std::set<std::string> excluded;  ///< nodes
};

class SlurmRun {
 public:
  SlurmRun(const Plan& plan, const SlurmOptions& options)
      : plan_(plan), options_(options), demands_{options.memory_mb, options.minutes, {}} {}

  CampaignState Run() {
    CampaignState state = RefreshIndex(plan_);
    for (int t = 0; t < options_.tries && !state.missing.empty(); ++t) {
      Wait(Submit(state));
      state = RefreshIndex(plan_);
    }
    return state;
  }

 private:
  std::size_t EpisodesOfTask(const CampaignState& state) const {
    if (options_.per_task > 0) return static_cast<std::size_t>(options_.per_task);
    const double each_s = state.MeanWall_s();
    const double by_time = each_s > 0 ? std::ceil(kShortestTask_s / each_s) : 1;
    return static_cast<std::size_t>(std::max(1.0, by_time));
  }

  /// Writes the script of an array, each case of which is a task's episodes, and submits it.
  std::string Submit(const CampaignState& state) {
    const std::size_t count = state.missing.size(), most = static_cast<std::size_t>(MostTasks());
    const std::size_t each = std::max(EpisodesOfTask(state), (count + most - 1) / most),
                      tasks = (count + each - 1) / each;
    std::string script = fmt::format("#!/bin/sh\ncase $SLURM_ARRAY_TASK_ID in\n");
    for (std::size_t task = 0; task < tasks; ++task) {
      const auto begin = state.missing.begin() + static_cast<std::ptrdiff_t>(task * each);
      const auto end =
          state.missing.begin() + static_cast<std::ptrdiff_t>(std::min(count, (task + 1) * each));
      script += fmt::format("{}) numbers='{}';;\n", task, fmt::join(begin, end, " "));
    }
    script += fmt::format(
        "esac\nfor number in $numbers; do\n  {} campaign run {} --index $number\ndone\n",
        ShellWord(options_.program), ShellWord(plan_.folder));
    const fs::path file = plan_.folder / "slurm.sh";
    WriteWholeFile(file, script);
    std::string command = fmt::format(
        "sbatch --parsable --no-requeue --job-name={} --array=0-{} --output={} --open-mode=append",
        plan_.campaign.name, tasks - 1, ShellWord(plan_.folder / "logs/slurm_%A_%a.log"));
    if (demands_.memory_mb > 0) command += fmt::format(" --mem={}M", demands_.memory_mb);
    if (demands_.minutes > 0) command += fmt::format(" --time={}", demands_.minutes);
    if (!demands_.excluded.empty()) {
      command += fmt::format(" --exclude={}", fmt::join(demands_.excluded, ","));
    }
    const Answer answer = Ask(command + " " + options_.arguments + " " + ShellWord(file));
    if (answer.status != 0) {
      throw InputError("--on slurm", {FaultKind::kUnsupported,
                                      "Slurm refuses the array: " + answer.text +
                                          "; change --sbatch, --memory-mb or --minutes"});
    }
    const std::string job = answer.text.substr(0, answer.text.find_first_of(";\n"));
    Say(fmt::format("job {}: {} episodes in {} tasks", job, count, tasks));
    return job;
  }

  /// Waits until no task of the job is waiting or running, and learns from those that failed.
  void Wait(const std::string& job) {
    for (int silences = 0; silences < kSilences;) {
      std::this_thread::sleep_for(std::chrono::duration<double>(options_.poll_s));
      const Answer answer = Ask("scontrol --oneliner show job " + job);
      if (answer.status != 0 && answer.text.find("Invalid job id") == std::string::npos) {
        ++silences;
        continue;
      }
      silences = 0;
      if (!IsUnderWay(answer.text)) return Learn(answer.text);
    }
    throw InputError("--on slurm",
                     {FaultKind::kUnsupported,
                      fmt::format("the controller does not answer; job {} goes on without it, and "
                                  "the same command later goes on with what is missing then",
                                  job)});
  }

  static bool IsUnderWay(const std::string& tasks) {
    static const std::set<std::string> kUnderWay = {"PENDING",    "RUNNING",   "CONFIGURING",
                                                    "COMPLETING", "SUSPENDED", "REQUEUED"};
    for (const std::string& line : LinesOf(tasks)) {
      if (kUnderWay.contains(WordOf(line, "JobState"))) return true;
    }
    return false;
  }

  void Learn(const std::string& tasks) {
    bool lacked_memory = false, lacked_time = false;
    int minutes = demands_.minutes, memory_mb = demands_.memory_mb;
    std::map<std::string, int> ended;
    for (const std::string& line : LinesOf(tasks)) {
      const std::string state = WordOf(line, "JobState"), node = WordOf(line, "NodeList");
      if (state.empty() || state == "COMPLETED") continue;
      ++ended[state];
      if ((state == "NODE_FAIL" || state == "BOOT_FAIL") && !node.empty()) {
        demands_.excluded.insert(node);
      }
      lacked_memory = lacked_memory || state == "OUT_OF_MEMORY";
      lacked_time = lacked_time || state == "TIMEOUT" || state == "DEADLINE";
    }
    constexpr int kFirstMemory_mb = 4000, kFirstMinutes = 60;  ///< where the cluster's were too few
    if (lacked_memory) demands_.memory_mb = std::max(2 * memory_mb, kFirstMemory_mb);
    if (lacked_time) demands_.minutes = std::max(2 * minutes, kFirstMinutes);
    for (const auto& [state, count] : ended) Say(fmt::format("{} tasks ended by {}", count, state));
  }

  void Say(const std::string& text) const {
    if (options_.say) options_.say(text);
  }

  const Plan& plan_;
  const SlurmOptions& options_;
  Demands demands_;
};

}  // namespace

CampaignState RunOnSlurm(const Plan& plan, const SlurmOptions& options) {
  return SlurmRun(plan, options).Run();
}

}  // namespace tera
