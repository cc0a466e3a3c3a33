#pragma once

#include <yaml-cpp/yaml.h>

namespace tera::internal {

/// Applies YAML 1.1 merge keys: each mapping below `node` gains the mappings that its key `<<`
/// names. The mapping's own keys win, followed by earlier items of a list. Throws YAML::Exception
/// with the place if `<<` holds another type.
void ApplyMergeKeys(const YAML::Node& node);

}  // namespace tera::internal
