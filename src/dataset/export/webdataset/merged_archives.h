#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "dataset/format/dataset_info.h"

namespace tera {

/// A recording among several that share archives.
struct MergedEpisode {
  std::string name;  ///< begins the names of its samples, "000012"
  std::filesystem::path dataset;
  std::string part;  ///< "train"; empty: there are no parts
};

struct MergedArchivesOptions {
  std::vector<std::string> sensors;  ///< channels; empty: all cameras and lidars
  std::int64_t shard_bytes = 0;      ///< about the size of an archive
  std::filesystem::path card;  ///< publisher's facts for card and croissant.json; may be empty
  DatasetInfo about;           ///< name and seed, for the card
};

/// Writes archives in WebDataset's form, one set PART-MACHINE_SENSOR-000000.tar for each part and
/// sensor, with samples of all episodes in the given order. Memory holds one sample. Returns the
/// text of the card; empty without `card`.
///
/// Throws  InputError if a recording cannot be read or has none of the sensors, or if `folder`
///         cannot be written.
std::string WriteMergedArchives(const std::vector<MergedEpisode>& episodes,
                                const std::filesystem::path& folder,
                                const MergedArchivesOptions& options);

}  // namespace tera
