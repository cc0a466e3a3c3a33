#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "dataset/format/dataset_info.h"

namespace tera {

/// One of several recordings that share archives.
struct MergedEpisode {
  std::string name;  ///< prefix of its sample names, such as "000012"
  std::filesystem::path dataset;
  std::string part;  ///< split, such as "train"; empty without splits
};

struct MergedArchivesOptions {
  std::vector<std::string> sensors;  ///< channel paths; empty: all cameras and lidars
  std::int64_t shard_bytes = 0;      ///< approximate size of an archive
  std::filesystem::path card;  ///< file with the publisher's facts for the card and croissant.json;
                               ///< may be empty
  DatasetInfo about;           ///< name and seed shown on the card
};

/// Writes the samples of all episodes to WebDataset archives. Each split and sensor has its own set
/// PART-MACHINE_SENSOR-000000.tar; samples are in the order of `episodes`. Memory holds one sample.
/// Returns the text of the card, or an empty text without `card`.
///
/// Throws  InputError if a recording cannot be read or has none of the sensors, or if `folder`
///         cannot be written.
std::string WriteMergedArchives(const std::vector<MergedEpisode>& episodes,
                                const std::filesystem::path& folder,
                                const MergedArchivesOptions& options);

}  // namespace tera
