#pragma once

#include <cstdint>
#include <exception>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace tera {

/// Content of episode.yaml: how a complete episode was created.
struct EpisodeRecord {
  std::string fingerprint;  ///< fingerprint of the campaign
  int number = 0;
  int draw = 0;  ///< number of rejected draws before this one
  std::uint64_t seed = 0;
  std::map<std::string, std::string> values;  ///< values of factors and of `randomise`, by key
  std::vector<std::string> refused;           ///< for each earlier draw, the rule that rejected it
  std::string sha256;  ///< digest over dataset.yaml, scenario.yaml and frames.sha256
  std::int64_t bytes = 0, frames = 0;
  double simulated_s = 0;
  double wall_s = 0, peak_mb = 0;  ///< over all tries and draws
  std::string host;
};

/// Reason why an episode has no dataset. `tera campaign retry` deletes failures for which a retry
/// may succeed.
enum class FailureReason {
  kBadInput,  ///< the scenario with these values is invalid
  kRefused,   ///< every draw was rejected by the rules
  kBug,       ///< an error in TERA
  kMemory,    ///< lack of memory
  kKilled     ///< killed from outside
};
struct Failure {
  FailureReason reason = FailureReason::kBug;
  std::string message;
};

std::string NameOf(FailureReason reason);
/// Reason of a failure that threw this exception.
FailureReason ReasonOf(const std::exception& error);
/// True if another try may succeed.
bool IsWorthRetry(FailureReason reason);

void WriteRecord(const EpisodeRecord& record, const std::filesystem::path& file);
/// Throws InputError if the file is unreadable.
EpisodeRecord ReadRecord(const std::filesystem::path& file);
void WriteFailure(const Failure& failure, const std::filesystem::path& file);
Failure ReadFailure(const std::filesystem::path& file);

}  // namespace tera
