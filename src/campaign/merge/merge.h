#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>

#include "campaign/plan/plan.h"

namespace tera {

struct MergeOptions {
  std::filesystem::path out;  ///< new or empty
  int every_frame = 10;       ///< lint opens one of so many frames of each camera and lidar
  std::function<void(int done, int episodes)> progress;
};

struct MergeReport {
  int episodes = 0, left_out = 0;        ///< failed ones are left out
  std::map<std::string, int> of_part;    ///< episodes
  std::int64_t archives = 0, bytes = 0;  ///< of the whole folder
};

/// Makes one dataset of all whole episodes: archives in WebDataset's form, the further formats, a
/// card, croissant.json (with the publisher's facts) and splits.csv. Every episode passes `tera
/// lint`, which also holds its files to their hashes. Order and bytes depend on the episodes alone.
///
/// Throws  InputError: episodes that are still to be made, an episode with an error, splits that
///         cannot be made, a folder that cannot be written. It then leaves nothing behind.
MergeReport Merge(const Plan& plan, const MergeOptions& options);

}  // namespace tera
