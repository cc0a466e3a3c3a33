#pragma once

#include <string>
#include <vector>

#include "dataset/format/channel.h"
#include "dataset/format/dataset_info.h"

namespace tera {

struct ChannelDescription {
  std::string path;  ///< folder, or file for tables and poses, relative to the dataset
  std::string type = std::string(kTableChannel);
};

inline constexpr int kDatasetFormat = 1;

/// File for the inputs of a recording until its dataset.yaml is written.
inline constexpr char kInputsOfStoppedName[] = "INCOMPLETE.inputs";

/// The text of dataset.yaml.
std::string DatasetYaml(const DatasetInfo& info, const std::vector<ChannelDescription>& channels);

/// The key `inputs` and its list in dataset.yaml's format.
std::string InputsYaml(const std::vector<RecordedInput>& inputs);

/// `text` as a double-quoted YAML scalar.
std::string YamlQuoted(const std::string& text);

/// This program's version, as written into datasets.
std::string_view TeraVersion();

}  // namespace tera
