#include "campaign/work/worker.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <fstream>
#include <map>
#include <optional>
#include <system_error>
#include <utility>

#include "campaign/work/episode_record.h"
#include "campaign/work/judge.h"
#include "dataset/files/checked_file.h"
#include "dataset/files/file_digest.h"
#include "dataset/files/folder_lock.h"
#include "dataset/files/whole_folder.h"
#include "dataset/format/recording.h"
#include "dataset/lint/lint.h"
#include "sim/run/generate.h"

namespace tera {
namespace fs = std::filesystem;
namespace {

double PeakMb() {
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return 1e-3 * static_cast<double>(usage.ru_maxrss);
}

std::string HostName() {
  std::array<char, 256> name = {};
  gethostname(name.data(), name.size() - 1);
  return name.data();
}

/// True if the computer is at fault instead of the episode: its disk, a driver or a missing
/// program. Then every episode would fail. A fault without a place concerns a driver or program.
bool IsOfTheComputer(const std::exception& error) {
  // includes errors of file systems
  if (dynamic_cast<const std::system_error*>(&error) != nullptr) return true;
  const auto* input = dynamic_cast<const InputError*>(&error);
  return input != nullptr && std::ranges::any_of(input->faults(), [](const InputFault& fault) {
           return fault.kind == FaultKind::kUnwritable ||
                  (fault.kind == FaultKind::kUnsupported && fault.place.empty());
         });
}

bool IsOfFilesIn(const fs::path& folder, const InputError& error) {
  return std::ranges::any_of(error.faults(), [&](const InputFault& fault) {
    return fault.place.starts_with(folder.string());
  });
}

/// Time and memory of all tries of an episode, stored in its work folder.
class Cost {
 public:
  /// A killed try is assumed to have lasted until its last write to a file.
  explicit Cost(const fs::path& work) : file_(work / "cost") {
    if (std::ifstream stream(file_); stream >> earlier_s_ >> peak_mb_) {
      const auto saved = fs::last_write_time(file_);
      auto last = saved;
      for (const auto& entry : fs::recursive_directory_iterator(work)) {
        last = std::max(last, entry.last_write_time());
      }
      earlier_s_ += std::chrono::duration<double>(last - saved).count();
    }
    Save();
  }
  void Save() const { WriteWholeFile(file_, fmt::format("{} {}\n", wall_s(), peak_mb())); }
  double wall_s() const {
    return earlier_s_ + std::chrono::duration<double>(Clock::now() - start_).count();
  }
  double peak_mb() const { return std::max(peak_mb_, PeakMb()); }

 private:
  using Clock = std::chrono::steady_clock;
  fs::path file_;
  double earlier_s_ = 0, peak_mb_ = 0;
  Clock::time_point start_ = Clock::now();
};

std::string DatasetDigest(const fs::path& dataset) {
  std::string digests;
  for (const char* file : {"dataset.yaml", "scenario.yaml", kFrameHashesName}) {
    digests += DigestOf(dataset / file).sha256;
  }
  return Sha256Of(digests);
}

std::int64_t BytesIn(const fs::path& folder) {
  std::int64_t bytes = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) bytes += static_cast<std::int64_t>(entry.file_size());
  }
  return bytes;
}

std::int64_t FramesIn(const fs::path& dataset) {
  const Recording recording(dataset);
  std::int64_t frames = 0;
  for (const ChannelForm form : {ChannelForm::kPictures, ChannelForm::kScans}) {
    for (const std::string& sensor : recording.SensorsOf(form)) {
      frames += static_cast<std::int64_t>(recording.FrameTimes(sensor).size());
    }
  }
  return frames;
}

/// Factor values and drawn values, by key.
std::map<std::string, std::string> ValuesOf(const Campaign& campaign, int number,
                                            const Scenario& scenario) {
  std::map<std::string, std::string> values;
  for (const std::string& drawn : scenario.drawn) {
    const std::size_t colon = drawn.find(": ");
    values[drawn.substr(0, colon)] = drawn.substr(std::min(drawn.size(), colon + 2));
  }
  for (const SetValue& value : DesignPoint(campaign, number)) values[value.key] = value.yaml;
  return values;
}

/// A try to create an episode in its work folder.
class Attempt {
 public:
  Attempt(const Plan& plan, int number, const WorkerOptions& options)
      : plan_(plan),
        number_(number),
        options_(options),
        work_(plan.WorkFolder(number)),
        cost_(work_) {}

  void Run() {
    for (int draw = 0; draw <= plan_.campaign.redraws; ++draw) {
      if (WasRefused(draw) || !Make(draw)) continue;
      MakeFolder(plan_.EpisodeFolder(number_).parent_path());
      GiveName(work_ / fmt::format("draw_{}", draw), plan_.EpisodeFolder(number_));
      fs::remove_all(work_);
      return;
    }
    throw InputError(fmt::format("episode {}", number_),
                     {FaultKind::kInconsistent,
                      fmt::format("all {} draws are refused, by {}; allow more redraws, or draw "
                                  "values that meet the rules more often",
                                  refused_.size(), RefusalsInWords())});
  }
  bool IsExhausted() const {
    return refused_.size() == static_cast<std::size_t>(plan_.campaign.redraws) + 1;
  }

 private:
  fs::path MarkOf(int draw) const { return work_ / fmt::format("draw_{}.refused", draw); }

  bool WasRefused(int draw) {
    if (!fs::exists(MarkOf(draw))) return false;
    refused_.push_back(ReadWholeFile(MarkOf(draw)));
    return true;
  }

  std::string RefusalsInWords() const {
    std::map<std::string, int> counts;
    for (const std::string& rule : refused_) ++counts[rule];
    std::string words;
    for (const auto& [rule, count] : counts) {
      words += fmt::format("{}rule '{}' {} times", words.empty() ? "" : ", ", rule, count);
    }
    return words;
  }

  void Simulate(const LoadedScenario& loaded, const fs::path& dataset) const {
    if (fs::exists(dataset / "dataset.yaml")) return;  // stopped while rules were checked
    const auto generate = [&] {
      Generate(loaded.scenario, loaded.resolved_yaml,
               {.out = dataset,
                .threads = options_.threads,
                .resume = true,
                .keep_state = plan_.campaign.outputs.keep_state,
                .egl = options_.egl});
    };
    if (!fs::exists(IncompleteOf(dataset))) return generate();
    try {
      generate();
    } catch (const InputError& error) {
      if (IsOfTheComputer(error) || !IsOfFilesIn(IncompleteOf(dataset), error)) throw;
      fs::remove_all(IncompleteOf(dataset));  // too damaged to resume
      generate();
    }
  }

  /// Creates the episode with this draw. Returns true if it is accepted; it is then complete, with
  /// its record.
  bool Make(int draw) {
    EpisodeRecord record{.fingerprint = plan_.fingerprint, .number = number_, .draw = draw};
    const fs::path folder = work_ / fmt::format("draw_{}", draw), dataset = folder / "data";
    const LoadedScenario loaded = EpisodeScenario(plan_.campaign, number_, draw);
    record.values = ValuesOf(plan_.campaign, number_, loaded.scenario);
    record.simulated_s = loaded.scenario.duration_s;
    MakeFolder(folder);
    Simulate(loaded, dataset);
    cost_.Save();
    if (const auto rule = BrokenRule(plan_.campaign.rules, dataset)) {
      WriteWholeFile(MarkOf(draw), *rule);
      refused_.push_back(*rule);
      fs::remove_all(folder);
      return false;
    }
    WriteFrameHashes(dataset);
    record.seed = EpisodeSeed(plan_.campaign, number_, draw);
    record.refused = refused_;
    record.sha256 = DatasetDigest(dataset);
    record.bytes = BytesIn(dataset);
    record.frames = FramesIn(dataset);
    record.wall_s = cost_.wall_s();
    record.peak_mb = cost_.peak_mb();
    record.host = HostName();
    WriteRecord(record, folder / "episode.yaml");
    return true;
  }

  const Plan& plan_;
  int number_;
  const WorkerOptions& options_;
  fs::path work_;
  Cost cost_;
  std::vector<std::string> refused_;
};

void RequireWorthRetry(const fs::path& file) {
  const Failure failure = ReadFailure(file);
  if (IsWorthRetry(failure.reason)) return;
  throw InputError(
      file.string(),
      {FaultKind::kInconsistent, fmt::format("the episode failed before ({}) and would fail again: "
                                             "{}\n`tera campaign retry --all` allows another try",
                                             NameOf(failure.reason), failure.message)});
}

}  // namespace

bool RunEpisode(const Plan& plan, int number, const WorkerOptions& options) {
  if (number < 0 || number >= plan.campaign.episodes) {
    throw InputError("--index", {FaultKind::kOutOfRange,
                                 fmt::format("{} is not an episode of {}, need 0 to {}", number,
                                             plan.folder.string(), plan.campaign.episodes - 1)});
  }
  if (fs::exists(plan.EpisodeFolder(number))) return true;
  RequireSameScenario(plan, number);
  MakeFolder(plan.WorkFolder(number));
  std::optional<FolderLock> lock;
  try {
    lock.emplace(plan.WorkFolder(number));
  } catch (const InputError& error) {
    if (error.faults().front().kind != FaultKind::kUnwritable) throw;
    return false;
  }
  if (fs::exists(plan.EpisodeFolder(number))) return true;  // completed by another worker
  const fs::path failure = plan.FailureFile(number);
  if (fs::exists(failure)) RequireWorthRetry(failure);
  fs::remove(failure);
  Attempt attempt(plan, number, options);
  try {
    attempt.Run();
  } catch (const std::exception& error) {
    if (IsOfTheComputer(error)) throw;
    MakeFolder(failure.parent_path());
    WriteFailure({attempt.IsExhausted() ? FailureReason::kRefused : ReasonOf(error), error.what()},
                 failure);
    throw;
  }
  return true;
}

}  // namespace tera
