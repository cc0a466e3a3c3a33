#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>

#include "campaign/plan/plan.h"

namespace tera {

struct MergeOptions {
  std::filesystem::path out;  ///< output folder, new or empty
  int every_frame = 10;       ///< lint opens one out of this many frames of each camera and lidar
  std::function<void(int done, int episodes)> progress;
};

struct MergeReport {
  int episodes = 0, left_out = 0;        ///< number of failed episodes, which are left out
  std::map<std::string, int> of_part;    ///< number of episodes by split
  std::int64_t archives = 0, bytes = 0;  ///< of all files in the folder
};

/// Merges all complete episodes into one dataset: WebDataset archives, additional formats, a card,
/// croissant.json (if there are publisher's facts) and splits.csv. Every episode is checked by
/// `tera lint`, including file hashes. Order and content depend only on the episodes.
///
/// Throws  InputError if episodes are missing, if lint finds an error, if splits are impossible, or
///         if the folder cannot be written. No files are left then.
MergeReport Merge(const Plan& plan, const MergeOptions& options);

}  // namespace tera
