#pragma once

#include <cstdint>
#include <exception>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace tera {

/// episode.yaml: how a whole episode came to be.
struct EpisodeRecord {
  std::string fingerprint;  ///< of its campaign
  int number = 0;
  int draw = 0;  ///< draws before it were refused
  std::uint64_t seed = 0;
  std::map<std::string, std::string> values;  ///< of factors and randomise:, by key
  std::vector<std::string> refused;           ///< the rule that refused each earlier draw
  std::string sha256;  ///< digest of dataset.yaml, scenario.yaml and frames.sha256
  std::int64_t bytes = 0, frames = 0;
  double simulated_s = 0;
  double wall_s = 0, peak_mb = 0;  ///< of all its tries and draws
  std::string host;
};

/// Why an episode ended without a dataset. `tera campaign retry` clears those of which another try
/// may end otherwise.
enum class FailureReason {
  kBadInput,  ///< of the scenario under these values
  kRefused,   ///< by the rules, draw after draw
  kBug,       ///< an error of TERA's own
  kMemory,    ///< there was too little
  kKilled     ///< from outside
};
struct Failure {
  FailureReason reason = FailureReason::kBug;
  std::string message;
};

std::string NameOf(FailureReason reason);
/// Why an attempt ended that threw this.
FailureReason ReasonOf(const std::exception& error);
/// Whether another try may end otherwise.
bool IsWorthRetry(FailureReason reason);

void WriteRecord(const EpisodeRecord& record, const std::filesystem::path& file);
/// Throws InputError.
EpisodeRecord ReadRecord(const std::filesystem::path& file);
void WriteFailure(const Failure& failure, const std::filesystem::path& file);
Failure ReadFailure(const std::filesystem::path& file);

}  // namespace tera
