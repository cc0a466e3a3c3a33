#pragma once

#include <string>
#include <vector>

#include "dataset/format/writer.h"

namespace tera {

/// What a channel holds, as dataset.yaml names it.
enum class ChannelType { kImu, kGnss, kEncoder, kCamera, kLidar, kTable, kPose };

std::string_view NameOf(ChannelType type);

struct ChannelDescription {
  std::string path;  ///< folder, or file for tables and poses, relative to the dataset
  ChannelType type = ChannelType::kTable;
};

inline constexpr int kDatasetFormat = 1;

/// The text of dataset.yaml.
std::string DatasetYaml(const DatasetInfo& info, const std::vector<ChannelDescription>& channels);

/// `text` as a double-quoted YAML scalar.
std::string YamlQuoted(const std::string& text);

/// This program's version, as written into datasets.
std::string_view TeraVersion();

}  // namespace tera
