#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "dataset/format/dataset_info.h"

namespace tera {

/// Facts that only the publisher of a dataset knows.
struct CardFacts {
  std::string description, license, url, date_published, version;
  std::string creator;
  bool creator_is_person = false;
};

/// Reads description, license (a URL), url, date_published (2026-05-01), person or organization,
/// and version (1.0.0). Throws InputError with the place of every fault.
CardFacts ReadCardFacts(const std::filesystem::path& file);

/// The archives of one sensor.
struct SensorArchives {
  struct Archive {
    std::string file;
    std::int64_t samples = 0, bytes = 0;
  };
  std::string sensor, name;          ///< "excavator1/front", "excavator1_front"
  std::vector<std::string> endings;  ///< endings of its samples' parts, "rgb.png"
  std::vector<Archive> archives;
};

/// croissant.json: the archives with their digests, a set of files in them for each part, and the
/// records.
///
/// Source  MLCommons, "Croissant Format Specification", version 1.1.
std::string CroissantJson(const std::filesystem::path& folder, const DatasetInfo& info,
                          const CardFacts& facts, const std::vector<SensorArchives>& sensors);

/// README.md: a dataset card with metadata for Hugging Face's hub.
std::string CardText(const DatasetInfo& info, const CardFacts& facts,
                     const std::vector<SensorArchives>& sensors);

}  // namespace tera
