#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "view/served_folder.h"

namespace tera {

/// A dataset or a diagnosis that is looked at.
struct Viewed {
  enum class Kind { kDataset, kDiagnosis };

  Kind kind = Kind::kDataset;
  std::string name;
  ServedFolder folder;
  std::string index_json;  ///< what the page is told of it
  /// Makes the bytes of a stage (stage_file.h); throws InputError where the scene is not known. Of
  /// datasets.
  std::function<std::string()> stage;
};

/// Throws InputError where the path is neither a dataset nor a diagnosis, or is one that cannot be
/// read.
Viewed OpenViewed(const std::filesystem::path& path);

/// All of them for the page: {"format": 1, "viewed": [...]}, with the excerpt's words if it is one;
/// of two datasets with `shift_ns`, by which times of the second are later, and `times`, why so.
std::string IndexJson(const std::vector<Viewed>& viewed, const std::string& excerpt = "");

/// At most so many datasets stand side by side.
inline constexpr std::size_t kMostDatasets = 2;

/// Throws InputError where there are more datasets than that, or none of anything.
void RequireFewDatasets(const std::vector<Viewed>& viewed);

}  // namespace tera
