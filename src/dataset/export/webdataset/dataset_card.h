#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "dataset/format/dataset_info.h"

namespace tera {

/// Facts about a dataset that only its publisher knows.
struct CardFacts {
  std::string description, license, url, date_published, version;
  std::string creator;
  bool creator_is_person = false;
};

/// Reads the keys description, license (a URL), url, date_published (2026-05-01), person or
/// organization, and version (1.0.0). Throws InputError with the place of every fault.
CardFacts ReadCardFacts(const std::filesystem::path& file);

/// Archives that hold the samples of one sensor.
struct SensorArchives {
  struct Archive {
    std::string file;
    std::int64_t samples = 0, bytes = 0;
  };
  std::string sensor, name;  ///< such as "excavator1/front" and its FlatName "excavator1_front"
  std::vector<std::string> endings;  ///< file name endings of the parts of a sample, such as
                                     ///< "rgb.png"
  std::vector<Archive> archives;
};

/// Text of croissant.json. It lists the archives with digests, a file set for each part of a
/// sample, and the fields of the records.
///
/// Source  MLCommons, "Croissant Format Specification", version 1.1.
std::string CroissantJson(const std::filesystem::path& folder, const DatasetInfo& info,
                          const CardFacts& facts, const std::vector<SensorArchives>& sensors);

/// Text of README.md: a dataset card with metadata for the Hugging Face Hub.
std::string CardText(const DatasetInfo& info, const CardFacts& facts,
                     const std::vector<SensorArchives>& sensors);

}  // namespace tera
