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

/// A planned campaign: a folder that holds all that a worker must know.
///
///     campaign.yaml     the campaign's file, as it was when planned
///     plan.yaml         fingerprint, digests of levels, version of TERA, folder of relative paths
///     episodes.csv      seed and factors of each episode, for reading
///     episodes/000012/  a whole episode: data/ (a dataset), episode.yaml
///     work/, failed/, logs/, index.sqlite
struct Plan {
  std::filesystem::path folder;  ///< absolute
  std::string fingerprint;       ///< digest of the campaign, its scenario, levels and inputs
  std::map<std::string, std::string> level_digests;  ///< of "key=level" that may name files
  Campaign campaign;

  std::filesystem::path EpisodeFolder(int number) const;
  std::filesystem::path WorkFolder(int number) const;
  std::filesystem::path FailureFile(int number) const;
  std::filesystem::path LogFile(int number) const;
};

/// A field of a table, quoted where it must be.
std::string CsvField(const std::string& text);

/// "000012".
std::string EpisodeName(int number);

/// Reads, checks and writes a campaign into `folder`. Planning the same campaign again changes
/// nothing. Loads episodes spread over the campaign (all of a small one). This finds unknown keys
/// and rules that no episode can fulfil.
///
/// Throws  InputError: faults of the campaign at their place; a folder of another campaign or of
///         another version of TERA.
Plan MakePlan(const std::filesystem::path& campaign, const std::filesystem::path& folder);

/// Reads a planned campaign. Throws InputError, also if it was planned by another version of TERA.
Plan LoadPlan(const std::filesystem::path& folder);

/// Throws InputError if the scenario of an episode is another than when planned: a file that it,
/// its inputs or the episode's levels name has changed.
void RequireSameScenario(const Plan& plan, int number);

/// Seed of a draw of an episode: hash(name, seed, number, draw), at most 53 bits.
std::uint64_t EpisodeSeed(const Campaign& campaign, int number, int draw);

/// The scenario of a draw of an episode. Throws InputError with the place of factors.
LoadedScenario EpisodeScenario(const Campaign& campaign, int number, int draw);

}  // namespace tera
