#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "view/served_folder.h"

namespace tera {

/// A dataset or diagnosis shown in the viewer.
struct Viewed {
  enum class Kind { kDataset, kDiagnosis };

  Kind kind = Kind::kDataset;
  std::string name;
  ServedFolder folder;
  std::string index_json;  ///< its entry in the index of the page
  /// Returns the scene in the format of stage_file.h; for datasets only. Throws InputError if the
  /// scene is unknown.
  std::function<std::string()> stage;
};

/// Throws InputError unless the path is a readable dataset or diagnosis.
Viewed OpenViewed(const std::filesystem::path& path);

/// Index of all items for the page: {"format": 1, "viewed": [...]}. An excerpt adds its
/// description. With two datasets, `shift_ns` is the offset of the second dataset's times, and
/// `times` explains it.
std::string IndexJson(const std::vector<Viewed>& viewed, const std::string& excerpt = "");

/// Largest number of datasets shown side by side.
inline constexpr std::size_t kMostDatasets = 2;

/// Throws InputError if `viewed` is empty or holds too many datasets.
void RequireFewDatasets(const std::vector<Viewed>& viewed);

}  // namespace tera
