#pragma once

#include <string>
#include <vector>

#include "dataset/format/channel.h"
#include "dataset/format/dataset_info.h"

namespace tera {

struct ChannelDescription {
  std::string path;  ///< path relative to the dataset: a folder for a sensor, a file for a table or
                     ///< poses
  std::string type = std::string(kTableChannel);
};

inline constexpr int kDatasetFormat = 1;

/// Holds the list of inputs while a recording is incomplete and has no dataset.yaml.
inline constexpr char kInputsOfStoppedName[] = "INCOMPLETE.inputs";

/// Text of dataset.yaml.
std::string DatasetYaml(const DatasetInfo& info, const std::vector<ChannelDescription>& channels);

/// The key `inputs` with its list, in the format of dataset.yaml.
std::string InputsYaml(const std::vector<RecordedInput>& inputs);

/// `text` as a double-quoted YAML scalar.
std::string YamlQuoted(const std::string& text);

/// Version of this program as datasets store it.
std::string_view TeraVersion();

}  // namespace tera
