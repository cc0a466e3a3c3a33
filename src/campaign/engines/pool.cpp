#include "campaign/engines/pool.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <deque>
#include <fstream>
#include <map>
#include <optional>

#include "core/check.h"
#include "core/error.h"
#include "dataset/files/checked_file.h"
#include "dataset/files/folder_lock.h"

namespace tera {
namespace fs = std::filesystem;
namespace {

constexpr double kUnmeasured_mb = 1000;
constexpr double kUsableShare = 0.9;  ///< fraction of the free memory
constexpr std::uintmax_t kFullDiskBytes = 1'000'000;
constexpr int kNotStarted = 127;  ///< exit status of a child whose program cannot be started

double AvailableMb() {
  std::ifstream stream("/proc/meminfo");
  std::string key, unit;
  for (double kb = 0; stream >> key >> kb; std::getline(stream, unit)) {
    if (key == "MemAvailable:") return kb / 1000;
  }
  return kUnmeasured_mb;
}

/// Runs in the child between fork and exec, where only async-signal-safe calls are allowed.
[[noreturn]] void BecomeWorker(const char* log, char* const* arguments) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  const int output = open(log, O_WRONLY | O_CREAT | O_TRUNC, 0644);
  const int nothing = open("/dev/null", O_RDONLY);
  if (output >= 0 && nothing >= 0) {
    dup2(nothing, STDIN_FILENO);
    dup2(output, STDOUT_FILENO);
    dup2(output, STDERR_FILENO);
    execv(arguments[0], arguments);
  }
  _exit(kNotStarted);
}

pid_t StartWorker(const Plan& plan, const PoolOptions& options, int number) {
  std::vector<std::string> words = {
      options.worker.program.string(), "campaign", "run", plan.folder.string(), "--index",
      std::to_string(number)};
  const std::vector<std::string>& further = options.worker.arguments;
  words.insert(words.end(), further.begin(), further.end());
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const std::string log = plan.LogFile(number).string();
  const pid_t child = fork();
  if (child == 0) BecomeWorker(log.c_str(), arguments.data());
  if (child < 0) FailFile(options.worker.program, "cannot be started again", errno);
  return child;
}

std::string EndOfLog(const fs::path& log) {
  constexpr std::size_t kMostBytes = 1000;
  const std::string text = fs::exists(log) ? ReadWholeFile(log) : "";
  return text.size() <= kMostBytes ? text : text.substr(text.size() - kMostBytes);
}

class Pool {
 public:
  Pool(const Plan& plan, const PoolOptions& options, const CampaignState& state)
      : plan_(plan),
        options_(options),
        left_(state.missing.begin(), state.missing.end()),
        done_(static_cast<int>(state.done.size())),
        failed_(static_cast<int>(state.failed.size())),
        available_mb_(kUsableShare * AvailableMb()),
        peak_mb_(state.LargestPeakMb()) {}

  void Run() {
    std::signal(SIGCHLD, SIG_DFL);  // if the parent ignored SIGCHLD, statuses of children would be
                                    // lost
    while (!left_.empty() || !running_.empty()) {
      while (!obstacle_ && !left_.empty() && HasRoom()) {
        running_[StartWorker(plan_, options_, left_.front())] = left_.front();
        left_.pop_front();
      }
      Show();
      if (running_.empty()) break;
      int status = 0;
      const pid_t child = waitpid(-1, &status, 0);
      if (const auto ended = running_.find(child); ended != running_.end()) {
        Finish(ended->second, status);
        running_.erase(ended);
      }
    }
    Show();
    if (obstacle_) throw InputError(plan_.folder.string(), *obstacle_);
  }

 private:
  using Clock = std::chrono::steady_clock;

  bool HasRoom() const {
    const auto count = static_cast<double>(running_.size());
    if (count == 0) return true;
    const double each_mb = peak_mb_ > 0 ? peak_mb_ : kUnmeasured_mb;
    return count < options_.processes && (count + 1) * each_mb <= available_mb_;
  }

  void Finish(int number, int status) {
    if (fs::exists(plan_.EpisodeFolder(number))) {
      ++done_;
      ++made_;
      const EpisodeRecord record = ReadRecord(plan_.EpisodeFolder(number) / "episode.yaml");
      peak_mb_ = std::max(peak_mb_, record.peak_mb);
      return;
    }
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;  // another worker runs this episode
    ++failed_;
    if (fs::exists(plan_.FailureFile(number))) return;
    // With a full disk every episode fails, and the log is incomplete.
    const bool is_full = fs::space(plan_.folder).available < kFullDiskBytes;
    if (WIFSIGNALED(status) && !is_full) {
      const int signal = WTERMSIG(status);
      const bool is_crash = std::ranges::find(kCrashSignals, signal) != kCrashSignals.end();
      WriteFailure(is_crash
                       ? Failure{FailureReason::kBug, fmt::format("crashed by signal {}", signal)}
                       : Failure{FailureReason::kKilled,
                                 fmt::format("was killed by signal {}; if memory ran out, run "
                                             "fewer at once with --processes",
                                             signal)},
                   plan_.FailureFile(number));
      return;
    }
    obstacle_ = InputFault(
        FaultKind::kUnwritable,
        fmt::format(
            "episode {} failed because of this computer{}; remove the cause and run again:\n{}",
            number, is_full ? ", a full disk" : "", EndOfLog(plan_.LogFile(number))));
  }

  void Show() const {
    if (!options_.progress) return;
    PoolProgress progress{.done = done_,
                          .failed = failed_,
                          .running = static_cast<int>(running_.size()),
                          .episodes = plan_.campaign.episodes};
    progress.wall_s = std::chrono::duration<double>(Clock::now() - start_).count();
    const int to_do = progress.episodes - done_ - failed_;
    if (made_ > 0) progress.left_s = progress.wall_s * to_do / made_;
    options_.progress(progress);
  }

  const Plan& plan_;
  const PoolOptions& options_;
  std::deque<int> left_;
  std::map<pid_t, int> running_;
  int done_, failed_, made_ = 0;
  double available_mb_, peak_mb_;
  std::optional<InputFault> obstacle_;
  Clock::time_point start_ = Clock::now();
};

}  // namespace

CampaignState RunPool(const Plan& plan, const PoolOptions& options) {
  const FolderLock lock(plan.folder);
  const CampaignState before = RefreshIndex(plan);
  Pool(plan, options, before).Run();
  return RefreshIndex(plan);
}

}  // namespace tera
