#pragma once

#include <yaml-cpp/yaml.h>

namespace tera::internal {

/// Applies YAML 1.1 merge keys (`<<`) in each mapping below `node`. Keys of the mapping itself win
/// over merged keys; in a list of merged mappings, earlier mappings win. Throws YAML::Exception
/// with line and column if the value of `<<` is not a mapping or a list of mappings.
void ApplyMergeKeys(const YAML::Node& node);

}  // namespace tera::internal
