#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "view/served_folder.h"

namespace tera {

/// A dataset or a diagnosis on view.
struct Viewed {
  enum class Kind { kDataset, kDiagnosis };

  Kind kind = Kind::kDataset;
  std::string name;
  ServedFolder folder;
  std::string index_json;  ///< its entry in the page's index
  /// Returns the bytes of a stage (stage_file.h), for datasets. Throws InputError if the scene is
  /// unknown.
  std::function<std::string()> stage;
};

/// Throws InputError if the path is neither a readable dataset nor a readable diagnosis.
Viewed OpenViewed(const std::filesystem::path& path);

/// Index of all items for the page: {"format": 1, "viewed": [...]}, with the excerpt's description
/// for an excerpt. Two datasets add `shift_ns`, the lag of the second dataset's times, and `times`,
/// its reason.
std::string IndexJson(const std::vector<Viewed>& viewed, const std::string& excerpt = "");

/// Maximum number of datasets shown side by side.
inline constexpr std::size_t kMostDatasets = 2;

/// Throws InputError for too many datasets, or for an empty list.
void RequireFewDatasets(const std::vector<Viewed>& viewed);

}  // namespace tera
