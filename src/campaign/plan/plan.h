#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "campaign/plan/campaign.h"
#include "campaign/plan/design.h"
#include "sim/scenario/load_scenario.h"

namespace tera {

/// A planned campaign. Its folder contains everything that a worker needs.
///
///     campaign.yaml     copy of the campaign file at the time of planning
///     plan.yaml         fingerprint, digests of levels, TERA version, base of relative paths
///     episodes.csv      seed and factors of each episode, for people
///     episodes/000012/  a complete episode: data/ (a dataset) and episode.yaml
///     work/, failed/, logs/, index.sqlite
struct Plan {
  std::filesystem::path folder;  ///< absolute path
  std::string fingerprint;       ///< digest of the campaign, its scenario, its levels and all input
                                 ///< files
  std::map<std::string, std::string> level_digests;  ///< digests for each "key=level" whose level
                                                     ///< may name a file
  Campaign campaign;

  std::filesystem::path EpisodeFolder(int number) const;
  std::filesystem::path WorkFolder(int number) const;
  std::filesystem::path FailureFile(int number) const;
  std::filesystem::path LogFile(int number) const;
};

/// A field of a CSV file, quoted if necessary.
std::string CsvField(const std::string& text);

/// Name of an episode's folder, such as "000012".
std::string EpisodeName(int number);

/// Reads and checks a campaign and writes the plan to `folder`. Planning the same campaign again
/// changes nothing. Some episodes, spread over the campaign, are loaded to detect unknown keys and
/// rules that no episode can meet; a small campaign is loaded completely.
///
/// Throws  InputError for faults of the campaign, with their place, and if the folder belongs to
///         another campaign or another TERA version.
Plan MakePlan(const std::filesystem::path& campaign, const std::filesystem::path& folder);

/// Reads a planned campaign. Throws InputError if it is unreadable or was planned by another TERA
/// version.
Plan LoadPlan(const std::filesystem::path& folder);

/// Throws InputError if the scenario of an episode has changed since planning. This happens if a
/// file that the scenario, its inputs or the levels name has changed.
void RequireSameScenario(const Plan& plan, int number);

/// Seed of a draw of an episode: hash(name, seed, number, draw), at most 53 bits.
std::uint64_t EpisodeSeed(const Campaign& campaign, int number, int draw);

/// Scenario for a draw of an episode. Throws InputError; faults of a factor's value have the
/// factor's place.
LoadedScenario EpisodeScenario(const Campaign& campaign, int number, int draw);

}  // namespace tera
